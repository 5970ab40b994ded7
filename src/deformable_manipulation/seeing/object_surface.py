"""Surfaces of the object and of its grips, as a camera sees them."""

import numpy as np

from deformable_manipulation.objects.spec import ObjectSpec

_SIDES = 6  # of a rod
_RINGS = 4  # of a ball, from pole to pole


def surface_of(points: np.ndarray, spec: ObjectSpec) -> np.ndarray:
    """Triangles (T, 3, 3) [m] of an object's surface.

    Args:
        points: (P, 3) m, its geometry points.
        spec: the object. The thickness of fabrics is left out.
    """
    faces = spec.faces()
    return tube(points, spec.margin) if faces is None else points[faces]


def tube(points: np.ndarray, radius: float) -> np.ndarray:
    """Triangles (T, 3, 3) [m] around each segment of a line of points (P, 3) [m]."""
    along = np.diff(points, axis=0)
    along /= np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-12)
    least = np.eye(3)[np.abs(along).argmin(axis=1)]
    first = np.cross(along, least)
    first /= np.maximum(np.linalg.norm(first, axis=1, keepdims=True), 1e-12)
    angles = 2.0 * np.pi * np.arange(_SIDES + 1) / _SIDES
    second = np.cross(along, first)
    ring = radius * (
        np.cos(angles)[:, None] * first[:, None] + np.sin(angles)[:, None] * second[:, None]
    )
    low, high = points[:-1, None] + ring, points[1:, None] + ring
    first_half = np.stack((low[:, :-1], low[:, 1:], high[:, 1:]), axis=2)
    other_half = np.stack((low[:, :-1], high[:, 1:], high[:, :-1]), axis=2)
    return np.concatenate((first_half, other_half)).reshape(-1, 3, 3)


def balls(centres: np.ndarray, radius: float) -> np.ndarray:
    """Triangles (T, 3, 3) [m] of balls around points (A, 3) [m]; none if they have no radius."""
    if radius <= 0.0:
        return np.empty((0, 3, 3))
    up = np.linspace(-0.5 * np.pi, 0.5 * np.pi, _RINGS + 1)
    around = np.linspace(0.0, 2.0 * np.pi, 2 * _RINGS + 1)
    grid = np.stack(
        (
            np.cos(up)[:, None] * np.cos(around),
            np.cos(up)[:, None] * np.sin(around),
            np.broadcast_to(np.sin(up)[:, None], (len(up), len(around))),
        ),
        axis=-1,
    )
    a, b, c, d = grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]
    ball = radius * np.stack((np.stack((a, b, c), axis=2), np.stack((a, c, d), axis=2)))
    return (centres[:, None, None] + ball.reshape(-1, 3, 3)).reshape(-1, 3, 3)
