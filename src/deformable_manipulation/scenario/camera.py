"""The section ``camera``: a simulated depth camera."""

from dataclasses import dataclass

from deformable_manipulation.geometry.pose import Vector
from deformable_manipulation.obstacles.spec import are_as_known
from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.names import FRAME, TOPIC
from deformable_manipulation.reading.parameter import parameter
from deformable_manipulation.reading.readers import (
    Integer,
    Node,
    Number,
    Report,
    Section,
    position,
)

_PLACE = position()
_LEAST_TILT = 1e-3  # of a view straight down or up: the picture would have no upright


@dataclass(frozen=True)
class CameraSpec:
    """A depth camera that stands still and sees all obstacles, the object and the grips."""

    position: Vector = parameter(_PLACE, "Where it is.")
    target: Vector = parameter(
        _PLACE, "What is in the middle of its image.", allowed="not straight above or below it"
    )
    width: int = parameter(Integer(8, 2000), "Pixels of a row.", default=240)
    height: int = parameter(Integer(8, 2000), "Rows.", default=180)
    field_of_view: float = parameter(
        Number("rad", at_least=0.1, at_most=2.6), "From the left to the right edge.", default=1.2
    )
    rate: float = parameter(
        Number("Hz", above=0.0),
        "Images per second.",
        default=15.0,
        allowed="at most `controller.rate`",
    )
    nearest: float = parameter(
        Number("m", at_least=0.01, at_most=100.0), "It sees nothing that is nearer.", default=0.3
    )
    farthest: float = parameter(
        Number("m", above=0.0, at_most=1000.0),
        "It sees nothing that is farther away.",
        default=8.0,
        allowed="above `nearest`",
    )
    noise: float = parameter(
        Number("m", at_least=0.0, at_most=0.1),
        "Standard deviation of the depth at 1 m; it grows with the square of the depth.",
        default=0.001,
    )
    holes: float = parameter(
        Number("1", at_least=0.0, at_most=0.95),
        "Probability that a pixel has no depth, beside those at the edges of things, which never "
        "have one.",
        default=0.02,
    )
    grips: float = parameter(
        Number("m", at_least=0.0, at_most=1.0),
        "Radius of the ball that it sees at each held point; 0: none.",
        default=0.03,
    )
    seed: int = parameter(
        Integer(0, 2**31 - 1),
        "Seed of noise and holes. The same seed gives the same images.",
        default=0,
    )
    topic: str = parameter(
        TOPIC,
        "Topic of its points. Relative to the namespace of the run.",
        default="camera/points",
    )
    frame: str = parameter(
        FRAME, "tf frame of its points: x to the right, y down, z forward.", default="camera"
    )


class _CameraSection(Section):
    """A section whose keys go together."""

    def __call__(self, node: Node):
        camera = super().__call__(node)
        across = [a - b for a, b in zip(camera.target[:2], camera.position[:2])]
        if max(map(abs, across)) < _LEAST_TILT:
            node.report.add(
                node.path + ("target",),
                "must not be straight above or below the camera's position",
                show(list(camera.target)),
            )
        if camera.farthest <= camera.nearest:
            node.report.add(
                node.path + ("farthest",),
                "must be above nearest, {:g} m".format(camera.nearest),
                show(camera.farthest),
            )
        return camera


CAMERA = _CameraSection(CameraSpec)


def check_camera(report: Report, frame: str, obstacles, controller, camera) -> None:
    """A rate that the cycles can follow, a frame of its own, and obstacles that it can show."""
    if camera is None:
        return
    if camera.rate > controller.rate:
        report.add(
            ("camera", "rate"),
            "must be at most controller.rate ({:g} Hz)".format(controller.rate),
            show(camera.rate),
        )
    if camera.frame == frame:
        report.add(("camera", "frame"), "must not be the fixed frame", show(frame))
    for index, obstacle in enumerate(obstacles):
        if obstacle.is_live and obstacle.topic == camera.topic:
            _check_shown(report, ("obstacles", str(index)), obstacle, camera)


def _check_shown(report: Report, path, obstacle, camera) -> None:
    """What a camera's images can be used for."""
    if obstacle.kind != "live_cloud":
        report.add(
            (*path, obstacle.kind),
            "must not be the topic of the camera, which has points of surfaces alone; use "
            "live_cloud, or another topic",
            show(obstacle.topic),
        )
    pixels = camera.width * camera.height
    if obstacle.least_points > pixels:
        report.add(
            (*path, "least_points"),
            "must be at most {}, the pixels of the camera".format(pixels),
            show(obstacle.least_points),
        )
    if obstacle.timeout * camera.rate <= 1.0:
        report.add(
            (*path, "timeout"),
            "must be above {:g} s, the time from one image of the camera to the next".format(
                1.0 / camera.rate
            ),
            show(obstacle.timeout),
        )


def check_live_obstacles(report: Report, obstacles, controller) -> None:
    """What is left out near the object is nearer than what the controllers keep off."""
    offset = controller.collision.offset
    for index, obstacle in enumerate(obstacles):
        if obstacle.is_live and 0.0 < offset <= obstacle.leave_out.object:
            report.add(
                ("obstacles", str(index), "leave_out", "object"),
                "must be below controller.collision.offset ({:g} m): what is nearer to the object "
                "is not seen".format(offset),
                show(obstacle.leave_out.object),
            )


def check_presence(report: Report, obstacles) -> None:
    """An obstacle is there, or in a map, or both."""
    for index, obstacle in enumerate(obstacles):
        if not obstacle.known and not obstacle.real:
            report.add(
                ("obstacles", str(index), "real"),
                "must not be false where known is, too; remove one of the two, or the obstacle",
                "false",
            )


def check_knowledge(report: Report, obstacles, knowledge) -> None:
    """Imperfect knowledge is of runs whose obstacles are known."""
    if not knowledge.sees_object and not are_as_known(obstacles):
        report.add(
            ("knowledge",),
            "cannot be combined with obstacles that are live, not known or not real; remove one of "
            "the two",
        )
