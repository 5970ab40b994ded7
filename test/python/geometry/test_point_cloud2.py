"""PointCloud2 messages of any layout, and broken ones."""

import numpy as np
import pytest
from cloud_messages import DATATYPES, message
from hypothesis import given
from hypothesis import strategies as st

from deformable_manipulation.cloud_formats import point_cloud2
from deformable_manipulation.mesh_formats.faces import FormatError


@given(
    types=st.lists(st.sampled_from(sorted(DATATYPES)), min_size=4, max_size=4),
    order=st.permutations(["x", "y", "z", "intensity"]),
    big=st.booleans(),
    gap=st.integers(0, 5),
    rows=st.integers(1, 4),
    padding=st.integers(0, 7),
    seed=st.integers(0, 1000),
)
def test_every_layout_is_read(types, order, big, gap, rows, padding, seed):
    points = np.random.default_rng(seed).integers(0, 100, (5 * rows, 4))
    cloud = message(points, types, order, big, gap, rows, padding)
    names = ("x", "y", "z", "intensity")
    found = point_cloud2.columns(cloud, names)
    assert (found == points[:, [order.index(name) for name in names]]).all()
    assert found.dtype == (np.float32 if set(types) == {"f4"} else np.float64)


def test_points_that_are_none_stay_where_they_are():
    points = np.array([(np.nan, 1.0, 2.0), (3.0, np.inf, 5.0)])
    np.testing.assert_array_equal(point_cloud2.columns(message(points)), points)


def test_rows_of_an_image_come_one_after_the_other():
    points = np.arange(36.0).reshape(12, 3)
    found = point_cloud2.columns(message(points, rows=3, padding=4))
    np.testing.assert_array_equal(found, points)


def test_a_single_row_need_not_tell_its_step():
    cloud = message(np.ones((4, 3)))
    cloud.row_step = 0
    assert point_cloud2.columns(cloud).shape == (4, 3)


def test_no_points():
    cloud = message(np.empty((0, 3)))
    assert point_cloud2.columns(cloud).shape == (0, 3)


def spoiled(**changes):
    cloud = message(np.ones((6, 3)), rows=2)
    for key, value in changes.items():
        setattr(cloud, key, value)
    return cloud


def with_field(place, **changes):
    cloud = spoiled()
    for key, value in changes.items():
        setattr(cloud.fields[place], key, value)
    return cloud


@pytest.mark.parametrize(
    "cloud, complaint",
    [
        (with_field(1, name="depth"), "it has no field y; its fields: 'x', 'depth', 'z'"),
        (with_field(1, name="x"), "it has more than one field x"),
        (with_field(2, datatype=9), "its field z has the datatype 9"),
        (with_field(2, offset=9), "its point_step is 12, but its field z ends at byte 13"),
        (spoiled(point_step=8), "its point_step is 8, but its field z ends at byte 12"),
        (spoiled(row_step=35), "its row_step is 35, but 3 points of 12 bytes are 36"),
        (spoiled(data=bytes(71)), "it has 71 bytes of data, but 2 x 3 points take 72"),
        (spoiled(width=1 << 30), "at most 20000000 can be read"),
        (spoiled(fields=[]), "its fields: none"),
    ],
)
def test_broken_messages(cloud, complaint):
    with pytest.raises(FormatError, match=complaint):
        point_cloud2.columns(cloud)
