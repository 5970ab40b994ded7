"""Points of a depth camera or a lidar as balls of one radius."""

from dataclasses import dataclass
from typing import Any, ClassVar, Sequence

import numpy as np

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
    noise: float = parameter(
        Number("m", at_least=0.0, at_most=0.1),
        "Of a depth camera: standard deviation of the depth at 1 m; at the depth d it is d^2 times "
        "as large. With a value above 0, what noise explains is smoothed, and what it may have "
        "moved away from a gripper, a shape or the object is left out, see below.",
        default=0.0,
    )
    timeout: float = TIMEOUT
    least_points: int = LEAST_POINTS
    leave_out: LeaveOut = LEAVE_OUT_OF_IT

    def cleaned(self, values: np.ndarray) -> np.ndarray:
        """See :class:`.LiveObstacle`; an image of a camera with noise is smoothed."""
        if not self.noise:
            return super().cleaned(values)
        from deformable_manipulation import _distance

        if values.ndim != 3:
            raise ValueError("it has no rows of points, as of an image, which `noise` needs")
        with np.errstate(invalid="ignore"):  # a pixel without a depth is not behind the camera
            if (values[:, :, 2] < 0.0).any():
                raise ValueError("it has points behind the camera; `noise` needs z to be the depth")
        smooth = values.copy()
        smooth[:, :, :3] *= _distance.smoothing_factors(values[:, :, 2], self.noise)[:, :, None]
        return smooth.reshape(-1, values.shape[-1])

    def piece(self, seen: SeenPoints) -> Any:
        """See :class:`.LiveObstacle`, like the other."""
        from deformable_manipulation import _distance

        cloud = _distance.PointCloud(seen.places)
        self.require(len(cloud), "points of which something can be made")
        return cloud

    def made_of(self, pieces: Sequence[Any]) -> Any:
        from deformable_manipulation import _distance

        return _distance.CloudObstacle(list(pieces), self.radius)
