"""The fabrics that are validated, and the simulation of them."""

from dataclasses import dataclass
from typing import Dict, Sequence

import numpy as np

from deformable_manipulation import _pbd

TIME_STEP = 0.01  # s
SUBSTEPS = 10
UPRIGHT = (0.0, 0.0, 0.0, 1.0)


@dataclass(frozen=True)
class FabricProperties:
    """What a fabric is made of; the defaults are those of a heavy cloth."""

    density: float = 1.0  # kg/m^2
    stretching_compliance: float = 1e-4  # m/N
    bending_compliance: float = 1e3  # 1/(N m)
    damping: float = 10.0  # 1/s


@dataclass(frozen=True)
class Mesh:
    """Vertices (P, 3) [m] and triangles (T, 3) of an unstretched fabric."""

    vertices: np.ndarray
    triangles: np.ndarray


def rectangle(size: Sequence[float], particles: Sequence[int], alternate: bool = False) -> Mesh:
    """Mesh a rectangle in the xy plane, row by row along x, each cell cut along a diagonal.

    size [m] and particles along x and y. Diagonals are parallel, or mirrored from row to row.
    """
    columns, rows = particles
    x, y = (np.linspace(0.0, length, count) for length, count in zip(size, particles))
    vertices = np.array([(a, b, 0.0) for b in y for a in x])
    triangles = []
    for row in range(rows - 1):
        for column in range(columns - 1):
            a = row * columns + column
            b, c, d = a + 1, a + columns, a + columns + 1
            if alternate and row % 2:
                triangles += [(a, b, c), (b, d, c)]
            else:
                triangles += [(a, b, d), (a, d, c)]
    return Mesh(vertices, np.array(triangles))


def make_fabric(mesh: Mesh, properties: FabricProperties, **options) -> _pbd.Fabric:
    """Make a fabric of a mesh."""
    return _pbd.Fabric(
        vertices=mesh.vertices,
        triangles=mesh.triangles,
        density=properties.density,
        thickness=0.001,
        stretching_compliance=properties.stretching_compliance,
        bending_compliance=properties.bending_compliance,
        damping=properties.damping,
        **{"gravity": (0.0, 0.0, -9.81), **options},
    )


def hang(
    mesh: Mesh,
    properties: FabricProperties,
    holds: Dict[int, Sequence[float]],
    substeps: int = SUBSTEPS,
    **options,
) -> _pbd.Fabric:
    """Settle a fabric with particles held at positions [m]. Raises RuntimeError if it moves on."""
    fabric = make_fabric(mesh, properties, **options)
    for particle, position in holds.items():
        fabric.hold(particle, "pinned", position, UPRIGHT)
    fabric.lay_out()
    if not fabric.settle(TIME_STEP, substeps):
        raise RuntimeError("the fabric did not settle")
    return fabric


def corners(particles: Sequence[int]) -> Sequence[int]:
    """Particles at the corners of a rectangle."""
    columns, rows = particles
    return 0, columns - 1, (rows - 1) * columns, rows * columns - 1
