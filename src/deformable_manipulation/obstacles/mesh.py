"""Triangle meshes in files."""

from dataclasses import dataclass
from typing import Any, ClassVar, Iterator, List, Optional, Tuple

import numpy as np

from deformable_manipulation.geometry.mesh_files import scaled_mended_mesh, scaled_mesh
from deformable_manipulation.geometry.pose import Quaternion, Vector
from deformable_manipulation.obstacles.drawings import Drawing, Surface
from deformable_manipulation.obstacles.motions import Motion
from deformable_manipulation.obstacles.spec import (
    KNOWN,
    MOTION_OF_OBSTACLE,
    NAME,
    REAL,
    ROTATION,
    TRANSLATION,
    ObstacleSpec,
    are_numbers,
)
from deformable_manipulation.reading.meshes import MeshFile, Scale
from deformable_manipulation.reading.origin import SPACE_ORIGIN
from deformable_manipulation.reading.parameter import parameter


@dataclass(frozen=True)
class MeshObstacle(ObstacleSpec):
    """The surface of triangles in a file.

    A vertex v of the file lies at ``translation + rotation * (scale * (v - origin))``.
    """

    kind: ClassVar[str] = "mesh"
    is_around_origin: ClassVar[bool] = True
    name: str = NAME
    mesh: str = parameter(
        MeshFile(),
        "OBJ, PLY, STL, COLLADA or another format; any number of triangles.",
        allowed="see below",
    )
    translation: Vector = TRANSLATION
    rotation: Quaternion = ROTATION
    scale: Vector = parameter(
        Scale(),
        "Metres per unit of the file, along its axes; 0.001 for a file in mm.",
        default=(1.0, 1.0, 1.0),
    )
    origin: Vector = parameter(
        SPACE_ORIGIN,
        "Subtracted from all vertices of the file, in its units (m for COLLADA and 3MF). Use it "
        "for files whose coordinates are far from 0.",
        default=(0.0, 0.0, 0.0),
    )
    motion: Optional[Motion] = MOTION_OF_OBSTACLE
    known: bool = KNOWN
    real: bool = REAL

    def problems(self) -> Iterator[str]:
        """See :class:`.ObstacleSpec`, like the others."""
        if not are_numbers(self.scale, 3) or not all(self.scale):
            yield "scale is {}; it must be three finite numbers other than 0".format(self.scale)
        yield from super().problems()

    def native(self) -> Tuple[Any, List[str]]:
        from deformable_manipulation import _distance

        mesh = scaled_mended_mesh(self)
        obstacle = _distance.MeshObstacle(*mesh[:2])
        return obstacle, [*mesh.warnings(), *obstacle.warnings]

    def corners(self) -> np.ndarray:
        return scaled_mesh(self)[0]

    def drawing(self) -> Drawing:
        vertices, triangles = scaled_mesh(self)
        return Surface(vertices[triangles])

    def description(self) -> str:
        scale = " x ".join("{:g}".format(s) for s in self.scale)
        return "mesh {}, scale {}".format(self.mesh, scale)
