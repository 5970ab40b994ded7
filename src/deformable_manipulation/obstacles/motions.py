"""The ``motion`` of an obstacle: where its pose comes from."""

from dataclasses import dataclass
from typing import Dict, Tuple, Union

from deformable_manipulation.geometry.pose import Quaternion, Vector
from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.names import FRAME, TOPIC
from deformable_manipulation.reading.parameter import Parameter, parameter
from deformable_manipulation.reading.readers import (
    Node,
    Report,
    Section,
    UnitQuaternion,
    position,
    read_items,
)
from deformable_manipulation.reading.times import TIME, check_times


@dataclass(frozen=True)
class PoseWaypoint:
    """Where an obstacle is at a time, relative to its own pose."""

    time: float = parameter(
        TIME, "When the obstacle is there.", allowed="increasing by at least 0.001"
    )
    position: Vector = parameter(
        position(),
        "Where it is, relative to `translation`, along the axes of the fixed frame.",
        default=(0.0, 0.0, 0.0),
    )
    orientation: Quaternion = parameter(
        UnitQuaternion(),
        "How far it is turned about its origin, after `rotation`. From one waypoint to the next it "
        "turns the shorter way round.",
        default=(0.0, 0.0, 0.0, 1.0),
    )


POSE_WAYPOINT = Section(PoseWaypoint)


class _PoseWaypoints:
    """A list of waypoints with increasing times."""

    type, unit, range = "list", "", "one or more"
    allowed = "a list of waypoints {time: s, position: [x, y, z], orientation: [x, y, z, w]}"

    def __call__(self, node: Node) -> Tuple[PoseWaypoint, ...]:
        if not isinstance(node.value, (list, tuple)) or not node.value:
            node.fail("must be {}".format(self.allowed))
        waypoints = read_items(node, POSE_WAYPOINT)
        check_times(node, waypoints)
        return waypoints


@dataclass(frozen=True)
class PathMotion:
    """An obstacle's scripted way; smooth between the waypoints, at rest before and after."""

    waypoints: Tuple[PoseWaypoint, ...] = parameter(
        _PoseWaypoints(),
        "A path, smooth between the waypoints like the leader's, at rest before the first and "
        "after the last. Time counts from the start or reset of the run.",
    )


@dataclass(frozen=True)
class TopicMotion:
    """An obstacle whose pose somebody publishes, as geometry_msgs/PoseStamped."""

    topic: str = parameter(
        TOPIC,
        "Topic with the pose of the obstacle's frame in the fixed frame "
        "(`geometry_msgs/PoseStamped`), from a tracker or from a marker dragged in RViz, for "
        "example. Relative to the namespace of the run.",
    )


@dataclass(frozen=True)
class FrameMotion:
    """An obstacle that is where a tf frame is."""

    frame: str = parameter(
        FRAME, "The obstacle's frame follows this tf frame.", allowed="not the fixed frame"
    )


Motion = Union[PathMotion, TopicMotion, FrameMotion]
_KINDS = {
    "waypoints": Section(PathMotion),
    "topic": Section(TopicMotion),
    "frame": Section(FrameMotion),
}


class MotionReader:
    """Exactly one source of poses."""

    type, unit, range = "section", "", ""
    declarations = {
        key: each for section in _KINDS.values() for key, each in section.declarations.items()
    }
    fields = {key: section.fields[key] for key, section in _KINDS.items()}
    others: Dict[str, Parameter] = {}
    allowed = "a section with one of the keys {}".format(", ".join(_KINDS))

    def spec_default(self, attribute: str):
        """See :meth:`~.readers.Section.spec_default`."""
        return Section.REQUIRED

    def __call__(self, node: Node) -> Motion:
        given = [key for key in _KINDS if isinstance(node.value, dict) and key in node.value]
        if len(given) != 1:
            node.fail("must be {}".format(self.allowed))
        return _KINDS[given[0]](node)


MOTION = MotionReader()


def check_frames(report: Report, frame: str, obstacles) -> None:
    """No obstacle is where the fixed frame is: that never moves."""
    for index, obstacle in enumerate(obstacles):
        if isinstance(obstacle.motion, FrameMotion) and obstacle.motion.frame == frame:
            report.add(
                ("obstacles", str(index), "motion", "frame"),
                "must not be the fixed frame; leave motion out for an obstacle that stands still",
                show(frame),
            )
