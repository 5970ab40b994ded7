"""Grids of signed distances."""

from dataclasses import dataclass
from typing import Any, ClassVar, List, Optional, Tuple

import numpy as np

from deformable_manipulation.geometry.field_files import Field, read_field
from deformable_manipulation.geometry.pose import Quaternion, Vector
from deformable_manipulation.obstacles.drawings import Dots, Drawing
from deformable_manipulation.obstacles.motions import Motion
from deformable_manipulation.obstacles.spec import (
    KNOWN,
    MOTION_OF_OBSTACLE,
    NAME,
    REAL,
    ROTATION,
    TRANSLATION,
    ObstacleSpec,
)
from deformable_manipulation.obstacles.unknown_space import FREE, OCCUPIED, UNKNOWN
from deformable_manipulation.reading.files import CheckedFile
from deformable_manipulation.reading.parameter import parameter

_FIELD_FILE = CheckedFile(
    "the name of an archive of NumPy (.npz) with distances, origin and spacing",
    lambda path, _: read_field(path, is_free_unknown=True),
)


@dataclass(frozen=True)
class FieldObstacle(ObstacleSpec):
    """Signed distances on a grid, interpolated trilinearly."""

    kind: ClassVar[str] = "field"
    name: str = NAME
    field: str = parameter(
        _FIELD_FILE, "Archive of NumPy with `distances`, `origin` and `spacing`."
    )
    unknown: str = parameter(
        UNKNOWN,
        "What is outside of the grid, and where its distances are nan. `occupied` is the safe "
        "choice; the object must start within the grid then.",
    )
    translation: Vector = TRANSLATION
    rotation: Quaternion = ROTATION
    motion: Optional[Motion] = MOTION_OF_OBSTACLE
    known: bool = KNOWN
    real: bool = REAL

    @property
    def endless(self) -> str:
        """See :class:`.ObstacleSpec`, like the others."""
        return "and all outside is occupied" if self.unknown == OCCUPIED else ""

    def native(self) -> Tuple[Any, List[str]]:
        from deformable_manipulation import _distance

        field, is_free = self._read(), self.unknown == FREE
        obstacle = _distance.FieldObstacle(
            field.distances, field.origin, field.spacing, is_free_outside=is_free
        )
        warnings = []
        if field.unknown:
            text = "{} of {} distances are nan: they count as {}"
            warnings = [text.format(field.unknown, field.distances.size, self.unknown)]
        return obstacle, warnings

    def corners(self) -> np.ndarray:
        field = self._read()
        extent = field.spacing * (np.array(field.distances.shape) - 1)
        return np.stack(np.meshgrid(*zip(field.origin, field.origin + extent)), axis=-1).reshape(
            -1, 3
        )

    def drawing(self) -> Drawing:
        """Cubes around the points of the grid that are next to the surface, inside."""
        field = self._read()
        inside = np.pad(field.distances < 0.0, 1, mode="edge")
        core = inside[1:-1, 1:-1, 1:-1].copy()
        for axis in range(3):
            for shift in (-1, 1):
                core &= np.roll(inside, shift, axis)[1:-1, 1:-1, 1:-1]
        shell = np.argwhere(inside[1:-1, 1:-1, 1:-1] & ~core)
        return Dots(field.origin + field.spacing * shell, float(field.spacing.min()), True)

    def description(self) -> str:
        return "field {}, unknown space {}".format(self.field, self.unknown)

    def _read(self) -> Field:
        return read_field(self.field, self.unknown == FREE)
