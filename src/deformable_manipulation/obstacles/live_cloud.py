"""Points of a depth camera or a lidar as balls of one radius."""

from dataclasses import dataclass
from typing import Any, ClassVar, Sequence

from deformable_manipulation.obstacles.leave_out import LeaveOut
from deformable_manipulation.obstacles.live import (
    LEAST_POINTS,
    LEAVE_OUT_OF_IT,
    TIMEOUT,
    LiveObstacle,
    SeenPoints,
    topic_with,
)
from deformable_manipulation.obstacles.spec import NAME
from deformable_manipulation.reading.parameter import parameter
from deformable_manipulation.reading.readers import LARGEST_COORDINATE, Number


@dataclass(frozen=True)
class LiveCloudObstacle(LiveObstacle):
    """The points that a topic brings, as balls."""

    kind: ClassVar[str] = "live_cloud"
    name: str = NAME
    live_cloud: str = topic_with("the points (`sensor_msgs/PointCloud2`), of any layout")
    radius: float = parameter(
        Number("m", at_least=0.0, at_most=LARGEST_COORDINATE),
        "Of the ball around each point, as of a [cloud](#obstacles-cloud).",
    )
    hold: float = parameter(
        Number("s", at_least=0.0, at_most=5.0),
        "Points are kept for this long beside newer ones, so that what is hidden or not seen for "
        "a moment does not vanish. What moves leaves a trail as long. Costs time in proportion.",
        default=0.2,
    )
    timeout: float = TIMEOUT
    least_points: int = LEAST_POINTS
    leave_out: LeaveOut = LEAVE_OUT_OF_IT

    def piece(self, seen: SeenPoints) -> Any:
        """See :class:`.LiveObstacle`, like the other."""
        from deformable_manipulation import _distance

        cloud = _distance.PointCloud(seen.places)
        self.require(len(cloud), "points of which something can be made")
        return cloud

    def made_of(self, pieces: Sequence[Any]) -> Any:
        from deformable_manipulation import _distance

        return _distance.CloudObstacle(list(pieces), self.radius)
