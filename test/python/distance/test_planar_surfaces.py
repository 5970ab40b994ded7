"""Triangulated surfaces against polygons: both seen along the normal of the plane."""

import numpy as np
import planar_reference as reference
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from mesh_reference import fields
from planar_reference import COMB, HILLS, SQUARE, star

from deformable_manipulation import _distance

MANY = settings(max_examples=60, deadline=None)
seeds = st.integers(0, 2**32 - 1)
ONE = np.array([[0, 1, 2]])


def surface_distances(ring, points, triangles, band=0.2):
    """Fields of Distances of one copy, points (P, 2) of the xy plane."""
    calculator = _distance.MinimumDistance([_distance.PlanarObstacle(ring, "xy")], 0.0, band)
    lifted = np.column_stack((points, np.linspace(-1.0, 1.0, len(points))))
    return fields(calculator, lifted[None], triangles)


def deepest(ring, corners, accuracy=1e-5):
    """The greatest depth of a triangle (3, 2) in a polygon.

    It is cut into four again and again; what cannot be deeper than the best point is thrown away.
    """
    cells, best = np.asarray(corners, dtype=float)[None], -np.inf
    while len(cells):
        middles = cells.mean(axis=1)
        depths = -reference.signed_distances(ring, middles)
        best = max(best, depths.max())
        reach = np.linalg.norm(cells - middles[:, None], axis=2).max(axis=1)
        cells = cells[depths + reach > best + accuracy]
        a, b, c = np.moveaxis(cells, 1, 0)
        ab, bc, ca = (a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0
        quarters = ((a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca))
        cells = np.concatenate([np.stack(quarter, axis=1) for quarter in quarters])
    return best


@pytest.mark.parametrize(
    "corners, distance",
    [
        ([(-3.0, -3.0), (4.0, -3.0), (0.5, 6.0)], -0.5),  # around the square: its centre
        ([(0.4, 0.4), (0.6, 0.4), (0.5, 0.6)], -0.5),  # in it, around its centre
        ([(0.1, 0.1), (0.3, 0.1), (0.1, 0.2)], -1.0 / 6.0),  # in it, beside its centre
        ([(0.2, 1.3), (0.8, 1.3), (0.5, 2.0)], 0.3),  # above it
        ([(0.5, 0.9), (0.0, 2.0), (1.0, 2.0)], -0.1),  # a corner in it
        ([(0.5, 1.2), (0.5, 1.2), (0.5, 1.2)], 0.2),  # a point
    ],
)
@pytest.mark.parametrize("ring", [SQUARE, SQUARE[::-1]])
def test_one_triangle_and_a_square(ring, corners, distance):
    found = surface_distances(ring, np.array(corners), ONE)
    assert found["minimum"] == pytest.approx([distance], abs=1e-12)


def test_triangle_over_a_ridge_of_level_depth():
    """In a rectangle all points of a line are equally deep."""
    block = ((0.0, 0.0), (4.0, 0.0), (4.0, 1.0), (0.0, 1.0))
    around = np.array([(-5.0, -5.0), (9.0, -5.0), (2.0, 20.0)])
    assert surface_distances(block, around, ONE)["minimum"] == pytest.approx([-0.5], abs=1e-12)
    end = np.array([(3.4, 0.3), (3.9, 0.3), (3.5, 0.9)])
    assert surface_distances(block, end, ONE)["minimum"] == pytest.approx([-0.5], abs=1e-12)


@MANY
@given(seed=seeds)
def test_one_triangle_anywhere(seed):
    rng = np.random.default_rng(seed)
    ring = np.array((SQUARE, HILLS, COMB)[rng.integers(3)]) if rng.random() < 0.5 else star(rng)
    corners = rng.uniform(-1.8, 1.8, 2) + rng.uniform(0.1, 2.5) * rng.standard_normal((3, 2))
    found = surface_distances(ring, corners, ONE)
    triangle, polygon = shapely.Polygon(corners), shapely.Polygon(ring)
    if polygon.intersects(triangle):
        expected = -deepest(ring, corners)
        assert expected - 1e-5 <= found["minimum"][0] <= expected + 1e-12
    else:
        assert found["minimum"][0] == pytest.approx(polygon.distance(triangle), abs=1e-12)
    consistent(ring, found, corners)


def consistent(ring, found, points):
    """A feature's witnesses, weights and normal belong together."""
    assert found["weights"].sum(axis=1) == pytest.approx(1.0, abs=1e-12)
    assert (found["weights"] >= 0.0).all()
    material = np.einsum("mk,mki->mi", found["weights"], np.asarray(points)[found["vertices"]])
    assert found["object_point"][:, :2] == pytest.approx(material, abs=1e-12)
    expected = reference.signed_distances(ring, material)
    assert found["distance"] == pytest.approx(expected, abs=1e-9)
    arm = found["object_point"] - found["obstacle_point"]
    assert arm == pytest.approx(expected[:, None] * found["normal"], abs=1e-8)


def grid(rng, count=5):
    """A crumpled cloth: points (count^2, 2) in the plane, triangles (T, 3)."""
    u, v = np.meshgrid(np.linspace(-1.0, 1.0, count), np.linspace(-0.4, 0.4, count))
    points = np.column_stack((u.ravel(), v.ravel())) + 0.05 * rng.standard_normal((count**2, 2))
    corner = (np.arange(count - 1)[:, None] * count + np.arange(count - 1)).ravel()
    lower = np.column_stack((corner, corner + 1, corner + count))
    upper = np.column_stack((corner + 1, corner + count + 1, corner + count))
    return points, np.concatenate((lower, upper))


@MANY
@given(seed=seeds)
def test_every_triangle_in_the_band_has_its_feature(seed):
    rng = np.random.default_rng(seed)
    points, triangles = grid(rng)
    points += np.array((0.0, rng.uniform(0.9, 1.5)))
    found = surface_distances(HILLS, points, triangles)
    consistent(HILLS, found, points)
    polygon = shapely.Polygon(HILLS)
    expected = {}
    for corners in triangles:
        distance = polygon.distance(shapely.Polygon(points[corners]))
        expected[tuple(corners)] = distance or -deepest(HILLS, points[corners])
    minimum = min(expected.values())
    assert found["minimum"][0] == pytest.approx(minimum, abs=1e-5)
    rows = dict(zip(map(tuple, found["vertices"].tolist()), found["distance"]))
    for corners, distance in expected.items():
        if distance < minimum + 0.2 - 2e-5:
            assert rows.pop(corners) == pytest.approx(distance, abs=1e-5)
    assert all(expected[corners] < minimum + 0.2 + 2e-5 for corners in rows)


def test_a_flat_cloth_level_with_an_edge_is_represented_by_the_middles_of_its_triangles():
    points = np.array([(0.2, 1.1), (0.8, 1.1), (0.2, 1.1), (0.8, 1.1)])
    found = surface_distances(SQUARE, points, np.array([[0, 1, 2], [1, 3, 2]]))
    assert found["distance"] == pytest.approx([0.1, 0.1], abs=1e-12)
    assert sorted(found["object_point"][:, 0]) == pytest.approx([0.4, 0.6], abs=1e-9)
