"""Signed distances that a mapping program publishes while the run goes on."""

from dataclasses import dataclass
from typing import Any, ClassVar, Sequence, Tuple

from deformable_manipulation.geometry.field_points import field_of_points
from deformable_manipulation.obstacles.leave_out import LeaveOut
from deformable_manipulation.obstacles.live import (
    LEAST_POINTS,
    TIMEOUT,
    LiveObstacle,
    SeenPoints,
)
from deformable_manipulation.obstacles.nothing import nothing
from deformable_manipulation.obstacles.spec import NAME
from deformable_manipulation.obstacles.unknown_space import FREE, UNKNOWN
from deformable_manipulation.reading.names import TOPIC
from deformable_manipulation.reading.parameter import parameter
from deformable_manipulation.reading.readers import Number


@dataclass(frozen=True)
class LiveFieldObstacle(LiveObstacle):
    """Signed distances at points on a grid, interpolated trilinearly."""

    kind: ClassVar[str] = "live_field"
    fields: ClassVar[Tuple[str, ...]] = ("x", "y", "z", "intensity")
    leave_out = LeaveOut(object=0.0)  # a field does not tell what its distances are from
    name: str = NAME
    live_field: str = parameter(
        TOPIC,
        "Topic with points on a grid (`sensor_msgs/PointCloud2`) whose field `intensity` is the "
        "signed distance in m: `esdf_pointcloud` of voxblox. Relative to the namespace of the run.",
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

    def piece(self, seen: SeenPoints) -> Any:
        """See :class:`.LiveObstacle`, like the other."""
        if len(seen.values) < self.least_points:
            text = "it has {} distances; {} at least are needed"
            raise ValueError(text.format(len(seen.values), self.least_points))
        if not len(seen.values):
            return None
        from deformable_manipulation import _distance

        is_free = self.unknown == FREE
        field = field_of_points(seen.values[:, :3], seen.values[:, 3], self.spacing, is_free)
        obstacle = _distance.FieldObstacle(
            field.distances, field.origin, field.spacing, is_free_outside=is_free
        )
        obstacle.set_pose(seen.translation, seen.rotation)
        return obstacle

    def made_of(self, pieces: Sequence[Any]) -> Any:
        (newest,) = pieces
        return nothing() if newest is None else newest.another()
