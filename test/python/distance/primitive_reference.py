"""Distances to primitives computed another way: formulas in numpy, on many points."""

import numpy as np

from deformable_manipulation import _distance

MAKERS = {
    "half_space": lambda: _distance.PrimitiveObstacle.half_space((0.3, -0.4, 2.0)),
    "sphere": lambda: _distance.PrimitiveObstacle.sphere(0.4),
    "box": lambda: _distance.PrimitiveObstacle.box((0.6, 1.0, 0.3)),
    "cylinder": lambda: _distance.PrimitiveObstacle.cylinder(0.3, 0.8),
    "capsule": lambda: _distance.PrimitiveObstacle.capsule(0.25, 0.7),
}


def half_space(points):
    return points @ (np.array((0.3, -0.4, 2.0)) / np.linalg.norm((0.3, -0.4, 2.0)))


def sphere(points):
    return np.linalg.norm(points, axis=-1) - 0.4


def box(points):
    beyond = np.abs(points) - (0.3, 0.5, 0.15)
    return np.linalg.norm(np.maximum(beyond, 0.0), axis=-1) + np.minimum(beyond.max(axis=-1), 0.0)


def cylinder(points):
    aside = np.hypot(points[..., 0], points[..., 1]) - 0.3
    beyond = np.stack((aside, np.abs(points[..., 2]) - 0.4), axis=-1)
    return np.linalg.norm(np.maximum(beyond, 0.0), axis=-1) + np.minimum(beyond.max(axis=-1), 0.0)


def capsule(points):
    on_axis = np.clip(points[..., 2:], -0.35, 0.35) * (0.0, 0.0, 1.0)
    return np.linalg.norm(points - on_axis, axis=-1) - 0.25


SIGNED = {f.__name__: f for f in (half_space, sphere, box, cylinder, capsule)}


def least_of_segments(signed, starts, ends, rounds=16, count=9):
    """Least signed distances (K,) of segments (K, 3), each by ever finer samples around the best.

    That finds them, as the distances are convex: the least is between the best's neighbours.
    """
    low, high = np.zeros(len(starts)), np.ones(len(starts))
    for _ in range(rounds):
        along = np.linspace(low, high, count, axis=1)
        points = starts[:, None] + along[..., None] * (ends - starts)[:, None]
        distances = signed(points)
        best = np.argmin(distances, axis=1)
        rows = np.arange(len(best))
        low = along[rows, np.maximum(best - 1, 0)]
        high = along[rows, np.minimum(best + 1, count - 1)]
    return distances.min(axis=1)


def least_of_segment(signed, ends):
    """The same of one segment (2, 3)."""
    ends = np.array(ends, dtype=float)
    return least_of_segments(signed, ends[:1], ends[1:])[0]


def least_of_triangle(signed, corners, rounds=16, count=9):
    """The same of a triangle (3, 3): lines across it have least distances that are convex, too."""
    first, second, third = np.array(corners, dtype=float)
    low, high = 0.0, 1.0
    for _ in range(rounds):
        along = np.linspace(low, high, count)
        starts, ends = (first + along[:, None] * (corner - first) for corner in (second, third))
        distances = least_of_segments(signed, starts, ends)
        best = int(np.argmin(distances))
        low, high = along[max(best - 1, 0)], along[min(best + 1, count - 1)]
    return distances.min()
