"""Planar obstacles of the C++ core: moving ones, many corners, refusals."""

import numpy as np
import planar_reference as reference
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from mesh_reference import fields
from planar_reference import SQUARE
from scipy.spatial.transform import Rotation

from deformable_manipulation import _distance

seeds = st.integers(0, 2**32 - 1)


def coast(rng, count=2000):
    """A ring of many corners with bays in its bays."""
    angles = 2.0 * np.pi * np.arange(count) / count
    waves = [rng.normal() / k * np.sin(k * angles + rng.uniform(0, 7)) for k in (3, 7, 31, 127)]
    radii = 1.0 + 0.25 * np.tanh(np.sum(waves, axis=0))
    return radii[:, None] * np.column_stack((np.cos(angles), np.sin(angles)))


@settings(max_examples=8, deadline=None)
@given(seed=seeds)
def test_thousands_of_corners(seed):
    rng = np.random.default_rng(seed)
    ring = coast(rng)
    polygon = shapely.Polygon(ring)
    calculator = _distance.MinimumDistance([_distance.PlanarObstacle(ring, "xy")], 0.0, band=0.1)
    for _ in range(5):
        steps = rng.uniform(0.01, 0.2) * rng.standard_normal((20, 2))
        line = rng.uniform(-1.5, 1.5, 2) + steps.cumsum(axis=0)
        minimum = calculator.compute(np.column_stack((line, 0.0 * line[:, 0]))[None]).minimum[0]
        shape = shapely.LineString(line)
        if polygon.intersects(shape):
            low, high = reference.bounds_of_minimum(ring, line, 201)
            assert low - 1e-9 <= minimum <= high + 1e-12
        else:
            assert minimum == pytest.approx(polygon.distance(shape), abs=1e-12)


@settings(max_examples=30, deadline=None)
@given(seed=seeds, plane=st.sampled_from(["xy", "yz", "xz"]))
def test_a_moved_obstacle_is_as_a_new_one_there(seed, plane):
    rng = np.random.default_rng(seed)
    obstacle = _distance.PlanarObstacle(SQUARE, plane)
    moved = _distance.MinimumDistance([obstacle], 0.01, band=0.1)
    points = rng.uniform(-1.0, 1.0, (3, 6, 3))
    moved.compute(points)
    translation, rotation = rng.uniform(-1.0, 1.0, 3), Rotation.random(random_state=seed).as_quat()
    linear, angular = rng.uniform(-1.0, 1.0, (2, 3))
    obstacle.set_pose(translation, rotation, linear, angular)
    there = _distance.PlanarObstacle(SQUARE, plane, translation, rotation)
    new = _distance.MinimumDistance([there], 0.01, band=0.1)
    result, fresh = fields(moved, points), fields(new, points)
    arm = result["obstacle_point"] - translation
    assert result.pop("obstacle_velocity") == pytest.approx(linear + np.cross(angular, arm))
    assert (fresh.pop("obstacle_velocity") == 0.0).all()
    for name, expected in fresh.items():
        assert (result[name] == expected).all()


def test_all_mistakes_at_once():
    with pytest.raises(ValueError) as caught:
        _distance.PlanarObstacle(
            [(0, 0), (1, np.nan), (2e6, 1)], "zy", (np.inf, 0, 0), (0, 0, 0, 2)
        )
    for part in ("point 1", "point 2", "plane is 'zy'", "translation", "rotation"):
        assert part in str(caught.value)


@pytest.mark.parametrize(
    "ring, reason",
    [
        (SQUARE[:2], "3 distinct points"),
        (((0, 0), (1, 1), (2, 2)), "no area"),
        (((0, 0), (1, 1), (1, 0), (0, 1)), "crosses or touches itself"),
        (((0, 0), (2, 0), (2, 2), (1, 0), (0, 2)), "crosses or touches itself"),
        (((0, 0), (2, 0), (2, 2), (2, -1), (0, -1)), "crosses or touches itself"),
    ],
)
def test_rings_that_bound_no_region(ring, reason):
    with pytest.raises(ValueError, match=reason):
        _distance.PlanarObstacle(ring, "xy")


def test_a_pose_that_is_none_leaves_the_obstacle_where_it_was():
    obstacle = _distance.PlanarObstacle(SQUARE, "xy")
    with pytest.raises(ValueError, match="translation.*\nrotation"):
        obstacle.set_pose((np.nan, 0, 0), (0, 0, 0, 0))
    line = np.array([[(0.5, 1.5, 0.0), (0.5, 1.2, 0.0)]])
    calculator = _distance.MinimumDistance([obstacle], 0.0, band=0.1)
    assert calculator.compute(line).minimum == pytest.approx([0.2], abs=1e-12)


def test_far_from_the_origin():
    """Rounding is 1e-10 m there; a copy still has its features."""
    far = np.array((9e5, -8e5))
    calculator = _distance.MinimumDistance(
        [_distance.PlanarObstacle(np.array(SQUARE) + far, "xy")], 0.0, 0.0
    )
    line = np.array([(0.3, 1.4), (0.6, 1.25), (0.9, 1.7)]) + far
    result = calculator.compute(np.column_stack((line, np.zeros(3)))[None])
    assert result.minimum == pytest.approx([0.25], abs=1e-9)
    assert result.offsets.tolist() == [0, len(result.distance)] and len(result.distance) >= 1
