"""Signed distances of known configurations, and against dense sampling."""

import numpy as np
import planar_reference as reference
import pytest
import shapely
from planar_reference import HILLS, SQUARE, compute


@pytest.mark.parametrize("ring", [SQUARE, SQUARE[::-1], SQUARE + SQUARE[:1]])
@pytest.mark.parametrize(
    "line, distance",
    [
        ([(-0.5, 2.0), (1.5, 1.25)], 0.875 / np.hypot(2.0, 0.75)),  # above a corner
        ([(2.0, 0.2), (2.0, 0.3)], 1.0),  # beside an edge
        ([(0.2, 1.5), (0.8, 1.5)], 0.5),  # parallel to an edge
        ([(-1.0, 0.3), (2.0, 0.3)], -0.3),  # through it
        ([(0.4, 0.1), (0.6, 0.1)], -0.1),  # inside, parallel to an edge
        ([(0.1, 0.1), (0.9, 0.9)], -0.5),  # inside, along the diagonal
        ([(0.5, -1.0), (0.5, 0.25), (0.6, -1.0)], -0.25),  # one vertex inside
        ([(-1.0, 0.1), (0.2, 1.3)], 0.1 / np.sqrt(2.0)),  # past a corner
        ([(-1.0, 0.0), (0.1, 1.1)], 0.0),  # hits a corner, 0 to rounding
        ([(-1.0, 1.0), (2.0, 1.0)], 0.0),  # along an edge
        ([(1.0, 1.0), (2.0, 2.0)], 0.0),  # starts at a corner
    ],
)
def test_distance_to_a_square(ring, line, distance):
    result = compute(ring, line, radius=0.01)
    assert result.minimum == pytest.approx([distance - 0.01], abs=1e-12)


def test_rope_over_a_hill_reports_its_deepest_point():
    rope = [(-1.5, 0.6), (-1.0, 0.3), (-0.5, 0.4), (0.0, 0.45), (0.5, 0.42), (1.5, 0.6)]
    low, high = reference.bounds_of_minimum(HILLS, rope, 4001)
    assert -0.2 < low and high < -0.05
    assert low <= compute(HILLS, rope).minimum[0] <= high + 1e-9


def test_deepest_point_between_vertices_and_between_edges():
    # The first edge's depth is 0.6 t, the second one's 0.6 (1 - t): equal at half.
    wedge = [(0.0, 0.0), (2.0, 0.0), (1.0, 1.0)]
    line = [(0.0, 0.3), (2.0, 0.3)]
    result = compute(wedge, line)
    expected = min(0.3, 0.7 / np.sqrt(2.0))
    assert result.minimum == pytest.approx([-expected], abs=1e-12)


def test_no_change_of_sign_through_the_boundary_jumps():
    """A rod pushed through the side of a square: the distance changes like the displacement."""
    heights = np.linspace(1.05, 0.55, 101)
    values = [compute(SQUARE, [(0.2, h), (0.5, h - 0.01), (0.7, h)]).minimum[0] for h in heights]
    assert np.diff(values) == pytest.approx(np.diff(heights), abs=1e-12)


def test_circle_and_its_centre():
    """All edges are about equally far from the centre."""
    angles = np.linspace(0.0, 2.0 * np.pi, 101)[:-1]
    ring = np.column_stack((np.cos(angles), np.sin(angles)))
    apothem = np.cos(np.pi / 100.0)
    result = compute(ring, [(-0.5, 0.0), (0.7, 0.0)])
    assert result.minimum == pytest.approx([-apothem], abs=1e-9)
    assert result.object_point[0, :2] == pytest.approx([0.0, 0.0], abs=1e-4)


def test_fine_boundary_inside():
    """Many short edges near each other."""
    u = np.linspace(-1.0, 1.0, 1001)
    ring = np.vstack((np.column_stack((u, 0.05 * np.sin(7.0 * u))), [(1.0, -2.0), (-1.0, -2.0)]))
    line = np.column_stack((np.linspace(-0.6, 0.6, 15), np.full(15, -0.2)))
    low, high = reference.bounds_of_minimum(ring, line, 501)
    assert low <= compute(ring, line).minimum[0] <= high + 1e-9


def test_outside_agrees_with_shapely():
    rng = np.random.default_rng(5)
    polygon = shapely.Polygon(HILLS)
    compared = 0
    for _ in range(200):
        line = rng.uniform(-2.5, 2.5, 2) + 0.2 * rng.standard_normal((9, 2)).cumsum(axis=0)
        geometry = shapely.LineString(line)
        minimum = compute(HILLS, line, radius=0.02).minimum[0]
        if polygon.intersects(geometry):
            assert minimum <= -0.02
        else:
            compared += 1
            assert minimum == pytest.approx(polygon.distance(geometry) - 0.02, abs=1e-12)
    assert compared > 50


@pytest.mark.parametrize(
    "line",
    [
        [(0.3, 0.2), (0.3, 0.2)],
        [(1.0, 1.0), (1.0, 1.0), (1.0, 1.0)],
        [(0.5, 1.0), (0.5, 1.0)],
        [(2.0, 3.0), (2.0, 3.0), (2.0, 3.0)],
        [(0.5, 2.0), (0.5, 2.0), (0.5, 1.5), (0.5, 1.5), (0.7, 2.0)],
        [(0.5, 0.5), (0.5, 0.5), (0.5, 0.7), (0.5, 0.7)],
    ],
)
def test_segments_of_length_zero(line):
    """A rod along the plane's normal is a point in the plane."""
    result = compute(SQUARE, line, radius=0.01)
    _, expected = reference.bounds_of_minimum(SQUARE, line)  # at a vertex, which is a sample
    assert result.minimum == pytest.approx([expected - 0.01], abs=1e-9)
    for field in (result.distance, result.object_point, result.obstacle_point, result.weights):
        assert np.isfinite(field).all()
    assert np.linalg.norm(result.normal, axis=1) == pytest.approx(1.0, abs=1e-12)


def test_both_references_agree():
    points = np.random.default_rng(2).uniform(-2.5, 2.5, (200, 2))
    one_by_one = [reference.signed_distance(HILLS, point) for point in points]
    assert reference.signed_distances(HILLS, points) == pytest.approx(one_by_one, abs=1e-12)
    inside = shapely.contains_xy(shapely.Polygon(HILLS), points[:, 0], points[:, 1])
    assert ((np.array(one_by_one) < 0.0) == inside).all()
