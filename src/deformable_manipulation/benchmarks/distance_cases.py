"""Objects and obstacles for the subject ``distance``."""

from dataclasses import dataclass
from typing import Optional

import numpy as np

STATES = 20  # of a moving object, which calls take one after the other
STEP = 0.001  # m, from one to the next: 0.1 m/s at 100 Hz
DISPLACEMENT = 0.1  # m, of perturbed copies


@dataclass(frozen=True)
class MovingObject:
    """An object with its copies at several times, and its triangles (None: a polyline)."""

    states: np.ndarray  # (S, C, P, 3) m
    triangles: Optional[np.ndarray]

    def copies(self, count):
        """The same object with fewer or more copies."""
        first = self.states[:, :1]
        rng = np.random.default_rng(0)
        moved = first + DISPLACEMENT * rng.uniform(-1, 1, (1, count, 1, 3))
        return MovingObject(np.concatenate((first, moved[:, 1:]), axis=1), self.triangles)


def rope(copies, points=45, height=0.5):
    """A rope that hangs over a hill of the yz plane, and moves along it."""
    along = np.linspace(-1.0, 1.0, points)
    shape = np.column_stack((0.0 * along, along, height + 0.3 * along**2))
    return _moving(shape, None).copies(copies)


def fabric(copies, cells=14, height=1.3):
    """A wavy fabric of 2 m by 2 m over a ball or cube, which moves across it."""
    line = np.linspace(-1.0, 1.0, cells + 1)
    x, y = (axis.ravel() for axis in np.meshgrid(line, line, indexing="ij"))
    shape = np.column_stack((x, y, height + 0.1 * np.sin(2.0 * x) * np.cos(3.0 * y)))
    corner = np.arange(cells * (cells + 1)).reshape(cells, cells + 1)[:, :-1].ravel()
    down = corner + cells + 1
    halves = ((corner, down, corner + 1), (corner + 1, down, down + 1))
    triangles = np.concatenate([np.stack(half, axis=1) for half in halves])
    return _moving(shape, triangles).copies(copies)


def hill(corners=86):
    """A ring of the yz plane: a wavy hill on a block."""
    y = np.linspace(-2.0, 2.0, corners - 2)
    top = 0.3 * np.exp(-4.0 * y**2) + 0.03 * np.sin(9.0 * y)
    return tuple(map(tuple, np.column_stack((y, top)))) + ((2.0, -1.0), (-2.0, -1.0))


def ball(faces):
    """Vertices and triangles of a ball of radius 1 m with about that many; 12 are a cube's."""
    cells = max(1, round(np.sqrt(faces / 12.0)))
    line = np.tan(np.linspace(-np.pi / 4.0, np.pi / 4.0, cells + 1))
    u, v = (axis.ravel() for axis in np.meshgrid(line, line, indexing="ij"))
    corner = np.arange(cells * (cells + 1)).reshape(cells, cells + 1)[:, :-1].ravel()
    down = corner + cells + 1
    halves = ((corner, down, corner + 1), (corner + 1, down, down + 1))
    square = np.concatenate([np.stack(half, axis=1) for half in halves])
    sides = []
    for axis in range(3):
        for side in (-1.0, 1.0):
            points = np.empty((len(u), 3))
            points[:, axis] = side
            points[:, (axis + 1) % 3], points[:, (axis + 2) % 3] = u, side * v
            sides.append(points)
    vertices = np.concatenate(sides)
    if cells > 1:
        vertices /= np.linalg.norm(vertices, axis=1)[:, None]
    vertices = np.round(vertices, 12)  # the sides' common vertices become the same
    triangles = np.concatenate([square + len(u) * k for k in range(6)])
    return vertices, triangles


def _moving(shape, triangles):
    steps = STEP * np.arange(STATES)[:, None, None, None] * np.array([0.6, 0.8, 0.0])
    return MovingObject(shape[None, None] + steps, triangles)
