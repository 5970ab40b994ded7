"""Planar distances computed another way: one point and one edge at a time, densely sampled."""

import numpy as np

from deformable_manipulation.distance.minimum_distance import MinimumDistance
from deformable_manipulation.scenario.spec import PolygonObstacle

SQUARE = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))
# Two hills, one metre apart, on a block: concave between them.
HILLS = (
    (-2.0, -1.0),
    (2.0, -1.0),
    (2.0, 0.0),
    (1.0, 0.0),
    (0.5, 0.5),
    (0.0, 0.0),
    (-0.5, 0.5),
    (-1.0, 0.0),
    (-2.0, 0.0),
)
COMB = (
    (0.0, 0.0),
    (1.0, 0.0),
    (1.0, 1.0),
    (0.8, 1.0),
    (0.8, 0.2),
    (0.6, 0.2),
    (0.6, 1.0),
    (0.4, 1.0),
    (0.4, 0.5),
    (0.0, 0.5),
)


def star(rng):
    """A ring seen whole from the origin."""
    count = rng.integers(3, 30)
    angles = 2.0 * np.pi * (np.arange(count) + rng.uniform(0.0, 0.9, count)) / count
    radii = rng.uniform(0.3, 1.5, count) if rng.random() < 0.7 else np.ones(count)
    return radii[:, None] * np.column_stack((np.cos(angles), np.sin(angles)))


def obstacle(
    ring, plane="xy", translation=(0.0, 0.0, 0.0), rotation=(0.0, 0.0, 0.0, 1.0), name="obstacle"
):
    return PolygonObstacle(name, tuple(map(tuple, ring)), plane, translation, rotation)


def in_plane(points):
    """Points (..., 2) of the xy plane as points (..., 3), at different heights."""
    points = np.asarray(points, dtype=float)
    heights = 0.3 * np.arange(points.shape[-2])
    return np.concatenate(
        (points, np.broadcast_to(heights[:, None], points.shape[:-1] + (1,))), axis=-1
    )


def compute(ring, line, radius=0.0, band=0.1):
    """Distances of one polyline (P, 2) to one polygon of the xy plane."""
    calculator = MinimumDistance([obstacle(ring)], radius, band)
    return calculator.compute(in_plane(line)[None])


def signed_distance(ring, point):
    """To a polygon, from a point (2,): by the winding number and each edge in turn."""
    ring = np.asarray(ring, dtype=float)
    nearest, turns = np.inf, 0.0
    for start, end in zip(ring, np.roll(ring, -1, axis=0)):
        edge, arm = end - start, point - start
        along = min(max(edge @ arm / (edge @ edge), 0.0), 1.0)
        nearest = min(nearest, np.linalg.norm(arm - along * edge))
        arm_end = point - end
        turns += np.arctan2(arm[0] * arm_end[1] - arm[1] * arm_end[0], arm @ arm_end)
    return -nearest if abs(turns) > np.pi else nearest


def signed_distances(ring, points):
    """The same for many points (K, 2), all at once."""
    ring = np.asarray(ring, dtype=float)
    edge = np.roll(ring, -1, axis=0) - ring
    arm = points[:, None] - ring
    along = np.clip(np.sum(arm * edge, axis=2) / np.sum(edge**2, axis=1), 0.0, 1.0)
    nearest = np.linalg.norm(arm - along[:, :, None] * edge, axis=2).min(axis=1)
    arm_end = points[:, None] - np.roll(ring, -1, axis=0)
    cross = arm[..., 0] * arm_end[..., 1] - arm[..., 1] * arm_end[..., 0]
    turns = np.arctan2(cross, np.sum(arm * arm_end, axis=2)).sum(axis=1)
    return np.where(np.abs(turns) > np.pi, -nearest, nearest)


def at_arc_lengths(line, places):
    """Points (K, 2) of a polyline at arc lengths (K,); beyond the ends, the ends."""
    line = np.asarray(line, dtype=float)
    # Where a length is zero both points are the same.
    return np.column_stack([np.interp(places, _reached(line), line[:, k]) for k in (0, 1)])


def sample(line, count):
    """Points (K, 2) along a polyline and their arc lengths (K,).

    They are its own points and ``count`` evenly spaced ones.
    """
    reached = _reached(line)
    places = np.union1d(reached, np.linspace(0.0, reached[-1], count))
    return at_arc_lengths(line, places), places


def bounds_of_minimum(ring, line, count=1001):
    """Between which two values [m] a polyline's least signed distance is."""
    points, places = sample(line, count)
    least = signed_distances(ring, points).min()
    # It changes by no more than the way along the line.
    return least - 0.5 * np.diff(places).max(initial=0.0), least


def _reached(line):
    return np.concatenate(((0.0,), np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))))
