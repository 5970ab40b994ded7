"""Grids of distances from points that lie on one."""

import numpy as np
import pytest

from deformable_manipulation.geometry.field_points import field_of_points


def grid(shape=(3, 4, 5), spacing=0.1, origin=(1.0, -2.0, 0.05)):
    places = np.stack(np.meshgrid(*map(np.arange, shape), indexing="ij"), axis=-1).reshape(-1, 3)
    return origin + spacing * places


def test_points_in_any_order_are_the_grid():
    places = grid()
    order = np.random.default_rng(0).permutation(len(places))
    field = field_of_points(places[order], np.arange(60.0)[order], 0.1, True)
    np.testing.assert_array_equal(field.distances.ravel(), np.arange(60.0))
    assert field.origin == pytest.approx((1.0, -2.0, 0.05))
    assert (field.spacing == 0.1).all() and field.unknown == 0


@pytest.mark.parametrize("is_free, there", [(True, 59.0), (False, -0.1)])
def test_what_is_unknown(is_free, there):
    distances = np.arange(60.0)
    distances[1] = np.nan
    field = field_of_points(grid(), distances, 0.1, is_free)
    assert field.unknown == 1
    assert field.distances.ravel()[1] == pytest.approx(there)


@pytest.mark.parametrize(
    "places, distances, complaint",
    [
        (np.append(grid(), [(1.05, -2.0, 0.05)], axis=0), np.zeros(61), "is on no grid of 0.1 m"),
        (grid(shape=(3, 4, 1)), np.zeros(12), "is flat"),
        (grid(), np.full(60, np.nan), "none of its distances"),
        (grid(), np.full(60, np.inf), "beyond 1e6 m"),
        (np.array([(0.0, 0.0, 0.0), (1e5, 1e5, 1e5)]), np.zeros(2), "values; at most"),
    ],
)
def test_what_is_no_grid(places, distances, complaint):
    with pytest.raises(ValueError, match=complaint):
        field_of_points(places, distances, 0.1, True)
