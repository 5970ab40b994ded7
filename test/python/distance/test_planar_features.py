"""Features of the object: segments, witnesses, normals."""

import numpy as np
import planar_reference as reference
import pytest
import shapely
from planar_reference import HILLS, SQUARE, compute, in_plane, obstacle

from deformable_manipulation.distance.minimum_distance import MinimumDistance


def test_features_end_at_the_band():
    line = [(-1.0, 0.8), (0.0, 0.88), (1.0, 0.88)]
    narrow, wide = compute(HILLS, line, band=0.02), compute(HILLS, line, band=0.1)
    assert len(narrow.distance) == 1
    assert len(wide.distance) == 2
    assert narrow.minimum == pytest.approx(wide.minimum, abs=1e-12)


def test_segments_have_a_feature_each():
    line = np.column_stack((np.linspace(-1.5, 1.5, 16), np.full(16, 0.7)))
    result = compute(HILLS, line, band=0.25)
    polygon = shapely.Polygon(HILLS)
    expected = {
        s: polygon.distance(shapely.LineString(line[s : s + 2]))
        for s in range(15)
        if polygon.distance(shapely.LineString(line[s : s + 2])) <= 0.2 + 0.25
    }
    assert 8 < len(expected) < 15
    found = dict(zip(result.vertices[:, 0].tolist(), result.distance))
    assert len(result.distance) == len(expected)
    assert found == pytest.approx(expected, abs=1e-12)
    assert (np.diff(result.distance) >= 0.0).all()


def test_segments_inside_and_outside():
    line = np.column_stack((np.linspace(-1.5, 1.5, 31), np.full(31, 0.42)))
    result = compute(HILLS, line, band=0.3)
    bounds = [reference.bounds_of_minimum(HILLS, line[s : s + 2]) for s in range(30)]
    for segment, distance in zip(result.vertices[:, 0], result.distance):
        low, high = bounds[segment]
        assert low <= distance <= high + 1e-12
    assert len(set(result.vertices[:, 0])) == len(result.distance)
    expected = [s for s in range(30) if bounds[s][1] <= result.minimum[0] + 0.3]
    assert sorted(result.vertices[:, 0]) == expected
    assert result.distance[0] < 0.0 < result.distance[-1]


def test_a_segment_level_with_an_edge_is_represented_by_its_middle():
    line = [(0.1, 1.2), (0.3, 1.2), (0.9, 1.2), (1.5, 1.2)]
    result = compute(SQUARE, line)
    middles = {s: w for s, w in zip(result.vertices[:, 0].tolist(), result.weights[:, 1])}
    assert middles == pytest.approx({0: 0.5, 1: 0.5, 2: 0.05 / 0.6}, abs=1e-9)


def test_a_segment_over_two_equal_hills_is_not_represented_by_the_valley():
    result = compute(HILLS, [(-1.0, 0.8), (1.0, 0.8)])
    assert result.distance == pytest.approx([0.3], abs=1e-12)
    assert abs(result.object_point[0, 0]) == pytest.approx(0.5, abs=1e-9)


@pytest.mark.parametrize(
    "line", [[(-0.5, 1.3), (0.2, 1.2), (1.8, 0.9)], [(0.3, 0.9), (0.35, 0.75), (0.9, 1.4)]]
)
def test_witness_points(line):
    result = compute(SQUARE, line, radius=0.02, band=0.5)
    boundary = shapely.LinearRing(SQUARE)
    points = in_plane(line)
    for row in range(len(result.distance)):
        arm = result.object_point[row] - result.obstacle_point[row]
        centre_line = result.distance[row] + 0.02
        assert np.linalg.norm(arm) == pytest.approx(abs(centre_line), abs=1e-12)
        assert arm[2] == 0.0  # same coordinate along the plane's normal
        assert arm == pytest.approx(centre_line * result.normal[row], abs=1e-12)
        on_boundary = boundary.distance(shapely.Point(result.obstacle_point[row, :2]))
        assert on_boundary == pytest.approx(0.0, abs=1e-12)
        material = result.weights[row] @ points[result.vertices[row]]
        assert result.object_point[row] == pytest.approx(material, abs=1e-12)
        assert result.weights[row].sum() == pytest.approx(1.0, abs=1e-12)
        assert (result.weights[row] >= 0.0).all() and result.weights[row, 2] == 0.0


@pytest.mark.parametrize("height", [0.7, 0.45])
def test_normal_is_the_gradient_of_the_material_points_distance(height):
    line = [(-1.4, height + 0.1), (-0.55, height), (0.6, height + 0.03), (1.5, height + 0.3)]
    result = compute(HILLS, line, band=0.3)
    step = 1e-7
    for point, normal, distance in zip(result.object_point, result.normal, result.distance):
        for direction in np.eye(3):
            ahead = reference.signed_distance(HILLS, (point + step * direction)[:2])
            behind = reference.signed_distance(HILLS, (point - step * direction)[:2])
            if abs(ahead + behind - 2.0 * distance) < 0.1 * step:  # not on a kink
                assert (ahead - behind) / (2.0 * step) == pytest.approx(
                    normal @ direction, abs=1e-5
                )


def test_normal_inside_points_to_the_nearest_boundary():
    result = compute(SQUARE, [(0.5, 1.5), (0.5, 0.8), (0.6, 1.5)])
    assert result.distance == pytest.approx([-0.2, -0.2], abs=1e-12)  # the corner of both segments
    assert result.normal == pytest.approx(np.tile([0.0, 1.0, 0.0], (2, 1)), abs=1e-12)
    assert result.obstacle_point[:, :2] == pytest.approx(np.tile([0.5, 1.0], (2, 1)), abs=1e-12)


@pytest.mark.parametrize("gap", [0.0, 1e-17, -1e-17, 1e-13, -1e-13])
@pytest.mark.parametrize("ring", [SQUARE, SQUARE[::-1]])
def test_normal_on_the_boundary_is_the_edge_outward_normal(gap, ring):
    result = compute(ring, [(0.5, 2.0), (0.5, 1.0 + gap)])
    assert result.normal[0] == pytest.approx([0.0, 1.0, 0.0], abs=1e-9)
    assert result.distance[0] == pytest.approx(0.0, abs=1e-12)


def test_every_obstacle_gives_its_features():
    left = obstacle(SQUARE, translation=(-1.2, 0.0, 0.0), name="left")
    right = obstacle(SQUARE, translation=(0.3, 0.05, 0.0), name="right")
    far = obstacle(SQUARE, translation=(0.0, -5.0, 0.0), name="far")
    calculator = MinimumDistance([left, far, right], 0.01, band=0.1)
    line = in_plane([(-1.0, 1.2), (1.0, 1.2)])
    shifted = line + (0.0, 0.0, 5.0)
    result = calculator.compute(np.stack((line, shifted + (-1.0, 0.0, 0.0))))
    assert result.names == ("left", "far", "right")
    assert result.obstacle.tolist() == [2, 0, 0]
    assert result.distance == pytest.approx([0.14, 0.19, 0.19], abs=1e-12)
    assert result.offsets.tolist() == [0, 2, 3]
    assert result.minimum == pytest.approx([0.14, 0.19], abs=1e-12)
    assert result.of_copy(1) == slice(2, 3)


def test_overlapping_obstacles_count_one_by_one():
    shifted = obstacle(SQUARE, translation=(0.5, 0.0, 0.0), name="shifted")
    result = MinimumDistance([obstacle(SQUARE), shifted], 0.0, band=1.0).compute(
        in_plane([(0.2, 0.7), (1.4, 0.7)])[None]
    )
    assert result.distance[:2] == pytest.approx([-0.3, -0.3], abs=1e-12)
    assert sorted(result.obstacle[:2]) == [0, 1]


def test_without_obstacles_nothing_is_near():
    result = MinimumDistance([], 0.01).compute(np.zeros((2, 3, 3)))
    assert result.minimum.tolist() == [np.inf, np.inf]
    assert result.offsets.tolist() == [0, 0, 0]
    assert result.normal.shape == (0, 3)
