"""Grids of distances from points that lie on one."""

import numpy as np

from deformable_manipulation.geometry.field_files import MOST_VALUES, Field, filled

_OFF = 0.05  # of the spacing


def field_of_points(
    places: np.ndarray, distances: np.ndarray, spacing: float, is_free_unknown: bool
) -> Field:
    """The grid around points, where each is at a place of it; the places between are unknown.

    Args:
        places: (N, 3) m, N >= 1, finite.
        distances: (N,) m; nan: not known. Of points at the same place, the last counts.
        spacing: [m] of the grid.
        is_free_unknown: see :func:`.read_field`.

    Raises:
        ValueError: the points are on no such grid, the grid is too large or flat, or no distance
            is known.
    """
    low = places.min(axis=0)
    steps = (places - low) / spacing
    indices = np.rint(steps)
    off = np.abs(steps - indices).max(axis=1)
    if off.max() > _OFF:
        text = "the point ({:g}, {:g}, {:g}) is on no grid of {:g} m with the others"
        raise ValueError(text.format(*places[int(np.argmax(off))], spacing))
    size = indices.max(axis=0) + 1.0
    if size.prod() > MOST_VALUES:
        raise ValueError("its grid has {:.3g} values; at most {}".format(size.prod(), MOST_VALUES))
    if size.min() < 2:
        raise ValueError("its grid is flat; it must have two values at least along each axis")
    if not (np.abs(distances[~np.isnan(distances)]) <= 1e6).all():
        raise ValueError("a distance is beyond 1e6 m; those that are not known must be nan")
    grid = np.full(size.astype(int), np.nan, dtype=np.float32)
    grid[tuple(indices.astype(int).T)] = distances
    if np.isnan(grid).all():
        raise ValueError("none of its distances is a number")
    return filled(grid, low, np.full(3, spacing), is_free_unknown)
