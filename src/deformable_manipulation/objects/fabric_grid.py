"""Rectangular grids of particles: the fabrics that a scenario gives by size and resolution."""

from typing import Sequence, Tuple

from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.meshes import Mesh
from deformable_manipulation.reading.readers import Node, Unreadable

LARGEST_PARTICLE_COUNT = 20000
_WHOLE = 1e-6  # relative; sizes and resolutions are typed with a few digits


def read_grid(node: Node, size: Tuple[float, float], resolution: float) -> Mesh:
    """The mesh of a grid; reports sizes that hold no whole number of cells, and too many particles.

    Args:
        node: the ``object`` section.
        size: [m] along x and y.
        resolution: cells per metre.
    """
    cells = [length * resolution for length in size]
    broken = [axis for axis in range(2) if not _is_whole(cells[axis])]
    for axis in broken:
        node.report.add(
            node.path + ("size", str(axis)),
            "must hold a whole number of cells of 1 / resolution = {:.6g} m; nearest: {}".format(
                1.0 / resolution, _nearest_sizes(cells[axis], resolution)
            ),
            show(size[axis]),
        )
    if broken:
        raise Unreadable
    columns, rows = (round(count) for count in cells)
    particles = (columns + 1) * (rows + 1)
    if particles > LARGEST_PARTICLE_COUNT:
        node.report.add(
            node.path + ("resolution",),
            "makes {} x {} particles; at most {} are allowed, so lower it".format(
                columns + 1, rows + 1, LARGEST_PARTICLE_COUNT
            ),
            show(resolution),
        )
        raise Unreadable
    return grid_mesh(size, (columns, rows))


def grid_mesh(size: Sequence[float], cells: Tuple[int, int]) -> Mesh:
    """A grid in the xy plane from the origin, ``size`` [m] of so many ``cells`` along x and y.

    Particle = row * (cells[0] + 1) + column, columns along x. Diagonals alternate like the colours
    of a chessboard, so that the mesh prefers neither diagonal direction; every corner of the grid
    has one. Triangles are counterclockwise seen from +z.
    """
    columns, rows = cells
    vertices = tuple(
        (size[0] * column / columns, size[1] * row / rows, 0.0)
        for row in range(rows + 1)
        for column in range(columns + 1)
    )
    triangles = []
    for row in range(rows):
        for column in range(columns):
            near = row * (columns + 1) + column
            far = near + columns + 1
            if (row + column) % 2 == 0:
                triangles += [(near, near + 1, far + 1), (near, far + 1, far)]
            else:
                triangles += [(near, near + 1, far), (near + 1, far + 1, far)]
    return Mesh(vertices, tuple(triangles))


def _is_whole(cells: float) -> bool:
    return cells >= 1.0 - _WHOLE and abs(cells - round(cells)) <= _WHOLE * cells


def _nearest_sizes(cells: float, resolution: float) -> str:
    counts = sorted({max(1, int(cells)), int(cells) + 1})
    return " or ".join("{:.9g}".format(count / resolution) for count in counts)
