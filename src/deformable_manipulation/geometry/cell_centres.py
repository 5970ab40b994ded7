"""Cells of an octree, by the points in their middles."""

import numpy as np

_OFF = 0.05  # of a cell: single precision is off by that 5 km away, in cells of 1 cm
_LARGEST = 1 << 19  # cells from the origin, as far as the C++ core's reach
_MOST_CELLS = 20_000_000
_LEVELS = 16


def cells_around(centres: np.ndarray, size: float) -> np.ndarray:
    """The smallest cells that cells are made of, whose middles are known.

    Cells of an octree have the sizes s, 2 s, 4 s and so on, and lie on grids through the origin.
    So the middle of a cell tells its size: along each axis it is an odd multiple of half of that.

    Args:
        centres: (N, 3) m.
        size: s [m], of the smallest cells.

    Returns:
        (M, 3) int32: (i, j, k) reaches from s (i, j, k) to s (i + 1, j + 1, k + 1).

    Raises:
        ValueError: a point is no middle of a cell, or cells are too far away or too many.
    """
    halves = centres / (0.5 * size)
    whole = np.rint(halves)
    off = np.abs(halves - whole).max(axis=1, initial=0.0)
    numbers = whole.astype(np.int64)
    if np.abs(whole).max(initial=0.0) > 2 * _LARGEST:
        raise ValueError("a cell is more than {} cells from the origin".format(_LARGEST))
    levels = _powers_of_two(numbers)
    wrong = np.flatnonzero((off > _OFF) | (levels.min(axis=1) != levels.max(axis=1)))
    if len(wrong):
        text = "the point ({:g}, {:g}, {:g}) is not the middle of a cell of {:g} m or twice, four "
        raise ValueError((text + "times ... that").format(*centres[wrong[0]], size))
    level = levels[:, 0]
    if (8.0 ** level.astype(float)).sum() > _MOST_CELLS:
        raise ValueError("it has more than {} smallest cells".format(_MOST_CELLS))
    pieces = []
    for each in np.unique(level):
        corner = (numbers[level == each] - (1 << int(each))) // 2
        line = np.arange(1 << int(each))
        inside = np.stack(np.meshgrid(line, line, line, indexing="ij"), axis=-1).reshape(-1, 3)
        pieces.append((corner[:, None] + inside).reshape(-1, 3))
    return np.concatenate(pieces).astype(np.int32) if pieces else np.empty((0, 3), np.int32)


def _powers_of_two(numbers: np.ndarray) -> np.ndarray:
    """How often each number can be divided by two; of 0, _LEVELS."""
    lowest_bit = numbers & -numbers
    levels = np.zeros(numbers.shape, dtype=np.int64)
    for level in range(1, _LEVELS + 1):
        levels += lowest_bit % (1 << level) == 0
    return levels
