"""Cells of an octree from their middles."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from deformable_manipulation.geometry.cell_centres import cells_around

SIZE = 0.05  # m


def expected_cells(corner, level):
    """The smallest cells of a cell of twice, four times ... the size."""
    line = np.arange(1 << level)
    inside = np.stack(np.meshgrid(line, line, line, indexing="ij"), axis=-1).reshape(-1, 3)
    return (np.array(corner) << level) + inside


@given(
    st.lists(
        st.tuples(st.tuples(*[st.integers(-500, 500)] * 3), st.integers(0, 3)),
        min_size=1,
        max_size=20,
    )
)
def test_cells_of_all_sizes(cells):
    centres = [(np.array(corner) + 0.5) * SIZE * (1 << level) for corner, level in cells]
    found = cells_around(np.array(centres, dtype=np.float32), SIZE)
    wanted = np.concatenate([expected_cells(corner, level) for corner, level in cells])
    assert sorted(map(tuple, found.tolist())) == sorted(map(tuple, wanted.tolist()))


def test_no_cells():
    assert cells_around(np.empty((0, 3)), SIZE).shape == (0, 3)


@pytest.mark.parametrize(
    "centre, complaint",
    [
        ((0.025, 0.025, 0.04), "is not the middle of a cell of 0.05 m"),
        ((0.025, 0.025, 0.05), "is not the middle"),  # a corner along z
        ((0.025, 0.025, 1e6), "from the origin"),
    ],
)
def test_points_that_are_no_middles(centre, complaint):
    with pytest.raises(ValueError, match=complaint):
        cells_around(np.array([(0.025, 0.025, 0.025), centre]), SIZE)


def test_a_cell_of_everything_is_too_much():
    with pytest.raises(ValueError, match="more than 20000000 smallest cells"):
        cells_around(np.full((1, 3), 0.5 * 512 * SIZE), SIZE)
