"""What obstacles have in common whose data come by a topic while the run goes on."""

from abc import abstractmethod
from typing import Any, ClassVar, List, NamedTuple, Sequence, Tuple

import numpy as np

from deformable_manipulation.geometry.pose import Quaternion, Vector
from deformable_manipulation.obstacles.drawings import Dots, Drawing
from deformable_manipulation.obstacles.leave_out import LEAVE_OUT, LeaveOut
from deformable_manipulation.obstacles.nothing import nothing
from deformable_manipulation.obstacles.spec import ObstacleSpec
from deformable_manipulation.reading.names import TOPIC
from deformable_manipulation.reading.parameter import parameter
from deformable_manipulation.reading.readers import Integer, Number

# Keys that every kind has. They stand in each class, in the order of its arguments.
TIMEOUT = parameter(
    Number("s", above=0.0, at_most=3600.0),
    "The assistants stop while the newest data are older.",
    default=0.5,
)
LEAST_POINTS = parameter(
    Integer(0, 10_000_000),
    "Data with fewer points, of which something can be made, are not used: a camera that sees "
    "nothing is broken or covered. With 0, they mean that nothing is there.",
    default=1,
)
LEAVE_OUT_OF_IT = parameter(
    LEAVE_OUT, "What is seen, but is no obstacle.", default=LeaveOut(), default_text="all defaults"
)


def topic_with(content: str) -> Any:
    """The declaration of the topic that the data come by.

    Args:
        content: of the messages, as a clause.
    """
    return parameter(TOPIC, "Topic with {}. Relative to the namespace of the run.".format(content))


class SeenPoints(NamedTuple):
    """What has come, without what is no obstacle: N points with K fields."""

    values: np.ndarray  # (N, K), as they came: x, y, z [m] in the frame of the data, and others
    places: np.ndarray  # (N, 3) m, in the fixed frame
    translation: Vector  # m, of the data's frame in the fixed frame
    rotation: Quaternion  # likewise


class LiveObstacle(ObstacleSpec):
    """An obstacle whose data come by a topic, as ``sensor_msgs/PointCloud2``.

    Attributes:
        fields: of a point in the messages.
        hold: for how long [s] data are kept beside newer ones.
        noise: of the depth [m] at 1 m, if the data are of a depth camera; otherwise 0.
    """

    is_live: ClassVar[bool] = True
    fields: ClassVar[Tuple[str, ...]] = ("x", "y", "z")
    translation = (0.0, 0.0, 0.0)
    rotation = (0.0, 0.0, 0.0, 1.0)
    motion = None
    known = True
    real = False
    hold = 0.0
    noise = 0.0
    timeout: float
    least_points: int
    leave_out: LeaveOut

    @property
    def topic(self) -> str:
        """Where the data come from."""
        return getattr(self, self.kind)

    @property
    def size_of_point(self) -> float:
        """How far [m] what is at a point may reach from it."""
        return 0.0

    def require(self, count: int, things: str) -> None:
        """Raise ValueError where data have too few things."""
        if count < self.least_points:
            text = "it has {} {}; {} at least are needed"
            raise ValueError(text.format(count, things, self.least_points))

    def cleaned(self, values: np.ndarray) -> np.ndarray:
        """Data (N, K), without the noise that can be told from what is there.

        Args:
            values: (N, K), or (H, W, K) if they are an image.

        Raises:
            ValueError: they are not as it needs; a clause that says why.
        """
        return values.reshape(-1, values.shape[-1])

    @abstractmethod
    def piece(self, seen: SeenPoints) -> Any:
        """Data as a part of the obstacle, ready to be searched; threads may share it.

        Raises:
            ValueError: nothing can be made of them; a clause that says why.
        """

    @abstractmethod
    def made_of(self, pieces: Sequence[Any]) -> Any:
        """The C++ core's obstacle of pieces, for one thread."""

    def native(self) -> Tuple[Any, List[str]]:
        """Nothing has come yet."""
        return nothing(), []

    def corners(self) -> np.ndarray:
        return np.empty((0, 3))

    def drawing(self) -> Drawing:
        return Dots(np.empty((0, 3)), 1.0)

    def at(self, translation: Vector, rotation: Quaternion) -> "LiveObstacle":
        """Itself: the data say where it is."""
        return self

    def description(self) -> str:
        return "{} from topic {}".format(self.kind, self.topic)


class LiveMapObstacle(LiveObstacle):
    """One whose newest data are all of it, and take the place of those before.

    Attributes:
        things: what the data are.
    """

    things: ClassVar[str]

    @abstractmethod
    def shape(self, values: np.ndarray) -> Any:
        """The C++ core's obstacle of at least one thing (N, K), in the frame of the data."""

    def piece(self, seen: SeenPoints) -> Any:
        """See :class:`LiveObstacle`, like the other."""
        self.require(len(seen.values), self.things)
        if not len(seen.values):
            return None
        obstacle = self.shape(seen.values)
        obstacle.set_pose(seen.translation, seen.rotation)
        return obstacle

    def made_of(self, pieces: Sequence[Any]) -> Any:
        (newest,) = pieces
        return nothing() if newest is None else newest.another()
