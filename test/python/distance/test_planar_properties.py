"""Properties on random polygons and polylines."""

import numpy as np
import planar_reference as reference
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from planar_reference import (
    COMB,
    HILLS,
    SQUARE,
    compute,
    in_plane,
    obstacle,
    star,
)
from scipy.spatial.transform import Rotation

from deformable_manipulation.distance.minimum_distance import MinimumDistance

SAMPLES = 2001
BAND = 0.2137  # m, off the grid of the lines, so that no distance is just at its end
MANY = settings(max_examples=60, deadline=None)
seeds = st.integers(0, 2**32 - 1)


def random_ring(rng):
    """Convex or not, of either orientation; some on a grid, as some lines are, which touch then."""
    if rng.random() < 0.3:
        ring = np.array((SQUARE, HILLS, COMB)[rng.integers(3)])
    else:
        ring = star(rng)
    return ring if rng.random() < 0.5 else ring[::-1]


def wanderer(rng, copies=None):
    """A polyline with few or many points, in, near and around the ring."""
    shape = (rng.integers(2, 14), 2) if copies is None else (copies, rng.integers(2, 14), 2)
    steps = rng.uniform(0.02, 0.6) * rng.standard_normal(shape)
    line = rng.uniform(-1.5, 1.5, 2) + np.cumsum(steps, axis=-2)
    return np.round(line, 1) if rng.random() < 0.3 else line  # rounded: repeated, parallel


@MANY
@given(seed=seeds)
def test_minimum_against_dense_sampling(seed):
    rng = np.random.default_rng(seed)
    ring, line = random_ring(rng), wanderer(rng)
    result = compute(ring, line, radius=0.01)
    low, high = reference.bounds_of_minimum(ring, line, SAMPLES)
    assert low - 1e-9 <= result.minimum[0] + 0.01 <= high + 1e-9


@MANY
@given(seed=seeds)
def test_features_are_consistent(seed):
    rng = np.random.default_rng(seed)
    ring, line = random_ring(rng), wanderer(rng)
    result = compute(ring, line, radius=0.01, band=BAND)
    points = in_plane(line)
    assert result.minimum[0] == result.distance[0]
    assert (np.diff(result.distance) >= 0.0).all()
    assert (result.distance <= result.minimum[0] + BAND + 1e-9).all()
    assert result.weights.sum(axis=1) == pytest.approx(1.0, abs=1e-12)
    material = np.einsum("mk,mki->mi", result.weights, points[result.vertices])
    assert result.object_point == pytest.approx(material, abs=1e-12)
    assert np.linalg.norm(result.normal, axis=1) == pytest.approx(1.0, abs=1e-9)
    expected = reference.signed_distances(ring, result.object_point[:, :2])
    assert result.distance == pytest.approx(expected - 0.01, abs=1e-9)
    arm = result.object_point - result.obstacle_point
    assert arm == pytest.approx(expected[:, None] * result.normal, abs=1e-8)
    on_boundary = reference.signed_distances(ring, result.obstacle_point[:, :2])
    assert on_boundary == pytest.approx(0.0, abs=1e-9)


@MANY
@given(seed=seeds)
def test_segments_in_the_band_are_all_there(seed):
    rng = np.random.default_rng(seed)
    ring, line = random_ring(rng), wanderer(rng)
    result = compute(ring, line, band=BAND)
    found = dict(zip(result.vertices[:, 0].tolist(), result.distance))
    assert len(found) == len(result.distance)
    for segment in range(len(line) - 1):
        low, high = reference.bounds_of_minimum(ring, line[segment : segment + 2], 501)
        if high <= result.minimum[0] + BAND:
            assert low - 1e-9 <= found[segment] <= high + 1e-9
        elif low > result.minimum[0] + BAND:
            assert segment not in found


@MANY
@given(seed=seeds, copies=st.integers(1, 13))
def test_copies_do_not_depend_on_each_other_or_on_history(seed, copies):
    rng = np.random.default_rng(seed)
    shifted = obstacle(random_ring(rng), translation=(0.4, 0.2, 0.0))
    obstacles = [obstacle(random_ring(rng)), shifted]
    points = in_plane(wanderer(rng, copies))
    points += np.append(rng.uniform(-2.0, 2.0, 2), 0.0)
    calculator = MinimumDistance(obstacles, 0.01, BAND)
    calculator.compute(3.0 * points[::-1])
    together = calculator.compute(points)
    for copy in range(copies):
        fresh = MinimumDistance(obstacles, 0.01, BAND)
        alone = fresh.compute(points[copy : copy + 1])
        assert together.minimum[copy] == pytest.approx(alone.minimum[0], abs=1e-9)
        first = together.of_copy(copy).start
        assert together.minimum[copy] == together.distance[first]
        if copy:
            assert together.offsets[copy + 1] - together.offsets[copy] == 1
        else:
            assert together.distance[together.of_copy(0)] == pytest.approx(alone.distance, abs=1e-9)


@MANY
@given(seed=seeds, plane=st.sampled_from(["xy", "yz", "xz"]))
def test_moving_everything_rigidly_changes_no_distance(seed, plane):
    rng = np.random.default_rng(seed)
    ring, line = random_ring(rng), in_plane(wanderer(rng))
    plain = MinimumDistance([obstacle(ring)], 0.01, BAND).compute(line[None])

    rotation, translation = Rotation.random(random_state=seed), rng.uniform(-3.0, 3.0, 3)
    turned = obstacle(ring, plane, tuple(translation), tuple(rotation.as_quat()))
    order = {"xy": [0, 1, 2], "yz": [2, 0, 1], "xz": [0, 2, 1]}[plane]

    def moved(points):
        return rotation.apply(points[..., order]) + translation

    result = MinimumDistance([turned], 0.01, BAND).compute(moved(line)[None])
    assert result.minimum == pytest.approx(plain.minimum, abs=1e-9)
    assert result.distance == pytest.approx(plain.distance, abs=1e-9)
    first = result.object_point[0] - result.obstacle_point[0]
    assert first @ result.normal[0] == pytest.approx(result.distance[0] + 0.01, abs=1e-9)
    along_normal = rotation.apply(np.eye(3)[{"xy": 2, "yz": 0, "xz": 1}[plane]])
    assert first @ along_normal == pytest.approx(0.0, abs=1e-9)
    assert result.normal @ along_normal == pytest.approx(0.0, abs=1e-9)
