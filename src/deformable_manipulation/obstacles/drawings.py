"""What is drawn of obstacles, in RViz and in plots."""

from typing import NamedTuple, Union

import numpy as np


class Surface(NamedTuple):
    """Triangles that face outwards."""

    triangles: np.ndarray  # (T, 3, 3) m, their corners


class Dots(NamedTuple):
    """Balls or cubes of one size."""

    places: np.ndarray  # (N, 3) m, their middles
    size: float  # m, from side to side
    are_cubes: bool = False


Drawing = Union[Surface, Dots]


def box_surface(low: np.ndarray, high: np.ndarray) -> Surface:
    """The faces of a box between two corners (3,) [m]."""
    corner = np.stack(np.meshgrid((0, 1), (0, 1), (0, 1), indexing="ij"), axis=-1).reshape(-1, 3)
    corner = low + corner * (np.asarray(high) - low)
    faces = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    halves = [[(a, b, c), (a, c, d)] for a, b, c, d in faces]
    return Surface(corner[np.array(halves).reshape(-1, 3)])


def turned_surface(profile: np.ndarray, sectors: int = 32) -> Surface:
    """A surface around the z axis.

    Args:
        profile: (K, 2) m, distances from the axis and heights, upwards; on the axis at both ends.
        sectors: how many flat strips it has.
    """
    angles = 2.0 * np.pi * np.arange(sectors + 1) / sectors
    around = np.stack((np.cos(angles), np.sin(angles)), axis=-1)
    rings = [np.column_stack((away * around, np.full(len(around), up))) for away, up in profile]
    triangles = []
    for lower, upper in zip(rings, rings[1:]):
        first, second, third, fourth = lower[:-1], lower[1:], upper[1:], upper[:-1]
        triangles += [np.stack((first, second, third), axis=1)]
        triangles += [np.stack((first, third, fourth), axis=1)]
    corners = np.concatenate(triangles)
    sides = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return Surface(corners[np.linalg.norm(sides, axis=1) > 0.0])
