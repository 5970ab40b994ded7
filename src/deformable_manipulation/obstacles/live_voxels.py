"""Occupied cells of a map that is made while the run goes on."""

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from deformable_manipulation.geometry.cell_centres import cells_around
from deformable_manipulation.obstacles.leave_out import LeaveOut
from deformable_manipulation.obstacles.live import (
    LEAST_POINTS,
    LEAVE_OUT_OF_IT,
    TIMEOUT,
    LiveMapObstacle,
    topic_with,
)
from deformable_manipulation.obstacles.spec import NAME
from deformable_manipulation.reading.parameter import parameter
from deformable_manipulation.reading.readers import Number


@dataclass(frozen=True)
class LiveVoxelObstacle(LiveMapObstacle):
    """The cells around the points that a topic brings, as one solid."""

    kind: ClassVar[str] = "live_voxels"
    things: ClassVar[str] = "cells"
    name: str = NAME
    live_voxels: str = topic_with(
        "the middles of occupied cells (`sensor_msgs/PointCloud2`): `octomap_point_cloud_centers` "
        "of octomap_server"
    )
    size: float = parameter(
        Number("m", at_least=1e-3, at_most=1e3), "Side of the smallest cell: the map's resolution."
    )
    timeout: float = TIMEOUT
    least_points: int = LEAST_POINTS
    leave_out: LeaveOut = LEAVE_OUT_OF_IT

    @property
    def size_of_point(self) -> float:
        """See :class:`.LiveObstacle`; to a corner of the smallest cell."""
        return 0.5 * np.sqrt(3.0) * self.size

    def shape(self, values: np.ndarray) -> Any:
        from deformable_manipulation import _distance

        return _distance.MeshObstacle.of_cells(cells_around(values, self.size), self.size)
