"""Triangulation of plane polygons in space by cutting off corners."""

from typing import List, Tuple

import numpy as np

_STRAIGHT = 1e-9  # sine of the turn at a corner that is none
_NO_TRIANGLE = (0, 0, 0)


def are_convex(corners: np.ndarray) -> np.ndarray:
    """Whether polygons (F, N, 3) turn the same way at each corner, and once around."""
    with np.errstate(all="ignore"):  # coordinates that are no numbers are refused later
        sides = np.roll(corners, -1, axis=1) - corners
        before = np.roll(sides, 1, axis=1)
        turns = np.einsum("fnk,fk->fn", np.cross(before, sides), _unit_normals(corners))
        along = np.einsum("fnk,fnk->fn", before, sides)
        lengths = np.linalg.norm(before, axis=2) * np.linalg.norm(sides, axis=2)
        around = np.arctan2(turns, along).sum(axis=1)
        return (turns > _STRAIGHT * lengths).all(axis=1) & (around < 3.0 * np.pi)


def ear_clipped(corners: np.ndarray) -> np.ndarray:
    """Triangles (N - 2, 3), indices of the corners (N, 3) of a polygon in space.

    The polygon may be concave, may have corners on its sides, and may hold holes that a bridge
    joins to the outline, there and back again. A polygon that crosses itself is cut somehow. Where
    nothing is left to fill, a triangle is (0, 0, 0).
    """
    flat = _flattened(corners)
    if not flat.any():
        return np.array([(0, k, k + 1) for k in range(1, len(corners) - 1)])
    left = list(range(len(corners)))
    triangles: List[Tuple[int, ...]] = []
    at = 0
    while len(left) > 3:
        at = _next_ear(flat, left, at)
        ear = (left[at - 1], left[at], left[(at + 1) % len(left)])
        triangles.append(ear if _are_apart(corners, *ear) else _NO_TRIANGLE)
        del left[at]
    triangles.append(tuple(left) if _are_apart(corners, *left) else _NO_TRIANGLE)
    return np.array(triangles)


def _unit_normals(corners: np.ndarray) -> np.ndarray:
    """Unit normals (F, 3) of polygons (F, N, 3) by their areas, seen along the axes (Newell)."""
    arms = corners - corners[:, :1]
    normals = np.cross(arms, np.roll(arms, -1, axis=1)).sum(axis=1)
    return normals / np.linalg.norm(normals, axis=1, keepdims=True)


def _flattened(corners: np.ndarray) -> np.ndarray:
    """Corners (N, 2) in the polygon's plane, counterclockwise, of size 1.

    All 0 if there is no such plane: the polygon's halves cancel out, or it is a line.
    """
    with np.errstate(all="ignore"):
        normal = _unit_normals(corners[None])[0]
        if not np.isfinite(normal).all():
            return np.zeros((len(corners), 2))
        dropped = int(np.argmax(np.abs(normal)))
        flat = np.delete(corners - corners[0], dropped, axis=1)
        if (normal[dropped] < 0.0) != (dropped == 1):
            flat[:, 0] *= -1.0
        return np.nan_to_num(flat / np.abs(flat).max())


def _next_ear(flat: np.ndarray, left: List[int], start: int) -> int:
    """A place in ``left`` whose corner can be cut off, the first one from ``start``."""
    count = len(left)
    ring = flat[left]
    sides = np.roll(ring, -1, axis=0) - ring
    before = np.roll(sides, 1, axis=0)
    turns = before[:, 0] * sides[:, 1] - before[:, 1] * sides[:, 0]
    lengths = np.linalg.norm(before, axis=1) * np.linalg.norm(sides, axis=1)
    back_and_forth = (np.roll(ring, 1, axis=0) == np.roll(ring, -1, axis=0)).all(axis=1)
    nothing = back_and_forth | (sides == 0.0).all(axis=1)
    if nothing.any():
        return int(np.argmax(nothing))
    for at in np.roll(np.arange(count), -start % count):
        if turns[at] > _STRAIGHT * lengths[at] and _is_ear(ring, at):
            return int(at)
    return int(np.argmax(turns))


def _is_ear(ring: np.ndarray, at: int) -> bool:
    """Whether no other corner is in the triangle at a corner, and no side crosses its third one."""
    a, b, c = ring[at - 1], ring[at], ring[(at + 1) % len(ring)]
    shared = (ring == a).all(axis=1) | (ring == b).all(axis=1) | (ring == c).all(axis=1)
    within = (_aside(a, b, ring) >= 0.0) & (_aside(b, c, ring) >= 0.0) & (_aside(c, a, ring) >= 0.0)
    if (within & ~shared).any():
        return False
    ends = np.roll(ring, -1, axis=0)
    apart = _aside(a, c, ring) * _aside(a, c, ends) < 0.0
    sides = ends - ring
    across_a = sides[:, 0] * (a[1] - ring[:, 1]) - sides[:, 1] * (a[0] - ring[:, 0])
    across_c = sides[:, 0] * (c[1] - ring[:, 1]) - sides[:, 1] * (c[0] - ring[:, 0])
    return not (apart & (across_a * across_c < 0.0)).any()


def _aside(start: np.ndarray, end: np.ndarray, points: np.ndarray) -> np.ndarray:
    """How far (K,) points (K, 2) are to the left of a line, times a length of it."""
    step = end - start
    return step[0] * (points[:, 1] - start[1]) - step[1] * (points[:, 0] - start[0])


def _are_apart(corners: np.ndarray, *three: int) -> bool:
    """Whether three of the corners are at three places."""
    a, b, c = corners[list(three)]
    return not ((a == b).all() or (b == c).all() or (c == a).all())
