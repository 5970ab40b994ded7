"""Occupied cells of a map as cubes."""

from dataclasses import dataclass
from typing import Any, ClassVar, List, Optional, Tuple

import numpy as np

from deformable_manipulation.geometry.octomap_files import (
    FORMATS,
    Octomap,
    OctomapError,
    read_octomap,
)
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
from deformable_manipulation.reading.readers import Node


def _read(path: str, node: Node) -> None:
    """Read a map, which must have cells of the kind that its surface is around."""
    cells = read_octomap(path)
    section = node.section if isinstance(node.section, dict) else {}
    if section.get("unknown") == FREE and not len(cells.occupied):
        raise OctomapError("{} has no occupied cell".format(path))
    if section.get("unknown") == OCCUPIED and not len(cells.free):
        raise OctomapError(
            "{} has no free cell, and all that is unknown shall be occupied".format(path)
        )


_MAP_FILE = CheckedFile("the name of a map ({})".format(FORMATS), _read)


@dataclass(frozen=True)
class VoxelObstacle(ObstacleSpec):
    """The occupied cells of an OctoMap as one solid, with those that are unknown or without."""

    kind: ClassVar[str] = "voxels"
    name: str = NAME
    voxels: str = parameter(
        _MAP_FILE, "OctoMap's `.bt` or `.ot`.", allowed="at most 20 million cells"
    )
    unknown: str = parameter(
        UNKNOWN,
        "What is unknown to the map, and all outside of it. `occupied` is the safe choice; it "
        "needs a map whose free space has been seen. With `free`, the object may go where nobody "
        "has looked.",
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

        cells, endless = self._map(), self.unknown == OCCUPIED
        surfaced = cells.free if endless else cells.occupied
        return _distance.MeshObstacle.of_cells(surfaced, cells.size, endless), []

    def corners(self) -> np.ndarray:
        cells = self._map()
        shown = cells.free if self.unknown == OCCUPIED else cells.occupied
        low, high = cells.size * shown.min(axis=0), cells.size * (shown.max(axis=0) + 1)
        return np.stack(np.meshgrid(*zip(low, high)), axis=-1).reshape(-1, 3)

    def drawing(self) -> Drawing:
        """The occupied cells; those that are unknown would hide all others."""
        cells = self._map()
        return Dots(cells.size * (cells.occupied + 0.5), cells.size, are_cubes=True)

    def description(self) -> str:
        return "voxels {}, unknown space {}".format(self.voxels, self.unknown)

    def _map(self) -> Octomap:
        return read_octomap(self.voxels)
