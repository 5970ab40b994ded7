"""Signed distances that a mapping program publishes while the run goes on."""

from dataclasses import dataclass
from typing import Any, ClassVar, Tuple

import numpy as np

from deformable_manipulation.geometry.field_points import field_of_points
from deformable_manipulation.obstacles.leave_out import LeaveOut
from deformable_manipulation.obstacles.live import (
    LEAST_POINTS,
    TIMEOUT,
    LiveMapObstacle,
    topic_with,
)
from deformable_manipulation.obstacles.spec import NAME
from deformable_manipulation.obstacles.unknown_space import FREE, UNKNOWN
from deformable_manipulation.reading.parameter import parameter
from deformable_manipulation.reading.readers import Number


@dataclass(frozen=True)
class LiveFieldObstacle(LiveMapObstacle):
    """Signed distances at points on a grid, interpolated trilinearly."""

    kind: ClassVar[str] = "live_field"
    things: ClassVar[str] = "distances"
    fields: ClassVar[Tuple[str, ...]] = ("x", "y", "z", "intensity")
    leave_out = LeaveOut(object=0.0)  # a field does not tell what its distances are from
    name: str = NAME
    live_field: str = topic_with(
        "points on a grid (`sensor_msgs/PointCloud2`) whose field `intensity` is the signed "
        "distance in m: `esdf_pointcloud` of voxblox"
    )
    spacing: float = parameter(
        Number("m", at_least=1e-3, at_most=1e3), "Of the grid: the size of the map's voxels."
    )
    unknown: str = parameter(
        UNKNOWN,
        "What is outside of the grid, and where no point is, as of a [field](#obstacles-field).",
    )
    timeout: float = TIMEOUT
    least_points: int = LEAST_POINTS

    def shape(self, values: np.ndarray) -> Any:
        """See :class:`.LiveMapObstacle`."""
        from deformable_manipulation import _distance

        is_free = self.unknown == FREE
        field = field_of_points(values[:, :3], values[:, 3], self.spacing, is_free)
        return _distance.FieldObstacle(
            field.distances, field.origin, field.spacing, is_free_outside=is_free
        )
