"""Which points are near elements, against brute force."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from deformable_manipulation import _distance


def nearest_on_triangles(points, elements):
    """Distances (N, E) [m], by projections onto all sides, and onto the face where it is above."""
    a, b, c = (elements[:, k] for k in range(3))
    best = np.full((len(points), len(elements)), np.inf)
    for start, end in ((a, b), (b, c), (c, a)):
        way = end - start
        length = np.maximum((way**2).sum(axis=1), 1e-300)
        t = ((points[:, None] - start) * way).sum(axis=2) / length
        nearest = start + np.clip(t, 0.0, 1.0)[..., None] * way
        best = np.minimum(best, np.linalg.norm(points[:, None] - nearest, axis=2))
    normal = np.cross(b - a, c - a)
    inside = np.ones_like(best, dtype=bool)
    for start, end in ((a, b), (b, c), (c, a)):
        inside &= (np.cross(end - start, points[:, None] - start) * normal).sum(axis=2) >= 0.0
    size = np.linalg.norm(normal, axis=1)
    above = np.abs(((points[:, None] - a) * normal).sum(axis=2)) / np.maximum(size, 1e-300)
    return np.where(inside & (size > 1e-12), np.minimum(best, above), best)


@pytest.mark.parametrize("kind", [np.float32, np.float64])
@given(seed=st.integers(0, 2**31), count=st.integers(1, 60))
@settings(max_examples=25, deadline=None)
def test_as_brute_force_says(kind, seed, count):
    rng = np.random.default_rng(seed)
    points = rng.uniform(-1.0, 1.0, (500, 3)).astype(kind)
    elements = rng.uniform(-1.0, 1.0, (count, 1, 3)) + rng.normal(0.0, 0.2, (count, 3, 3))
    elements[::3, 2] = elements[::3, 1]  # segments
    elements[1::5, 1:] = elements[1::5, :1]  # points
    reaches = rng.uniform(0.0, 0.3, count)
    gaps = nearest_on_triangles(points.astype(float), elements) - reaches
    found = _distance.near_elements(points, elements, reaches)
    clear = np.abs(gaps).min(axis=1) > 1e-9  # beyond rounding
    assert found.dtype == bool
    assert (found == (gaps <= 0.0).any(axis=1))[clear].all()


@given(seed=st.integers(0, 2**31))
@settings(max_examples=25, deadline=None)
def test_points_that_may_be_elsewhere_on_their_rays(seed):
    rng = np.random.default_rng(seed)
    points, origin, doubt = rng.uniform(-1.0, 1.0, (100, 3)), rng.uniform(-2.0, 2.0, 3), 0.05
    elements = rng.uniform(-1.0, 1.0, (10, 1, 3)) + rng.normal(0.0, 0.2, (10, 3, 3))
    elements[::3, 2] = elements[::3, 1]  # segments
    elements[1::5, 1:] = elements[1::5, :1]  # points
    reaches, farthest = rng.uniform(0.0, 0.2, 10), rng.uniform(0.2, 0.4, 10)
    found = _distance.near_elements(points, elements, reaches, farthest, origin, doubt)
    rays = points - origin
    steps = np.linspace(-1.0, 1.0, 201)
    length = doubt * np.linalg.norm(rays, axis=1)
    places = points[:, None] + steps[:, None] * (length[:, None] * rays)[:, None]
    gaps = nearest_on_triangles(places.reshape(-1, 3), elements).reshape(100, 201, 10).min(axis=1)
    allowed = nearest_on_triangles(points, elements) <= farthest
    between = 0.01 * doubt * (rays**2).sum(axis=1)[:, None]  # m, that the steps may have missed
    assert found[((gaps <= reaches) & allowed).any(axis=1)].all()
    assert not found[((gaps > reaches + between) | ~allowed).all(axis=1)].any()


def test_points_that_are_none_are_near_nothing():
    points = np.array([(np.nan, 0.0, 0.0), (0.0, np.inf, 0.0), (0.0, 0.0, 0.0)])
    marks = _distance.near_elements(points, np.zeros((1, 3, 3)), np.ones(1))
    assert marks.tolist() == [False, False, True]


def test_nothing_is_near_no_element():
    assert not _distance.near_elements(np.zeros((3, 3)), np.zeros((0, 3, 3)), np.zeros(0)).any()


@pytest.mark.parametrize(
    "points, elements, reaches, complaint",
    [
        (np.zeros((3, 2)), np.zeros((1, 3, 3)), np.ones(1), "points must be numbers"),
        (np.zeros((3, 3)), np.zeros((1, 2, 3)), np.ones(1), "elements must have the shape"),
        (np.zeros((3, 3)), np.zeros((1, 3, 3)), np.ones(2), "one reach for each"),
        (np.zeros((3, 3)), np.full((1, 3, 3), np.nan), np.ones(1), "not finite"),
        (np.zeros((3, 3)), np.zeros((1, 3, 3)), np.full(1, -1.0), "negative reach"),
    ],
)
def test_wrong_arguments(points, elements, reaches, complaint):
    with pytest.raises(ValueError, match=complaint):
        _distance.near_elements(points, elements, reaches)


@pytest.mark.parametrize(
    "rays, complaint",
    [
        ({"farthest": np.ones(2)}, "one farthest distance for each"),
        ({"doubt": -1.0}, "the rays have a number that is not finite, or a negative doubt"),
        ({"origin": (0.0, np.nan, 0.0)}, "the rays have a number that is not finite"),
    ],
)
def test_wrong_rays(rays, complaint):
    with pytest.raises(ValueError, match=complaint):
        _distance.near_elements(np.zeros((3, 3)), np.zeros((1, 3, 3)), np.ones(1), **rays)
