"""Maps of voxels in the scenario."""

import numpy as np
import pytest
from octomap_writing import Tree, bt
from visualization_msgs.msg import Marker

from deformable_manipulation.distance.minimum_distance import MinimumDistance
from deformable_manipulation.obstacles.spec import obstacle_corners
from deformable_manipulation.ros.obstacle_markers import obstacle_markers
from deformable_manipulation.scenario import scenario_from_mapping, scenario_to_mapping
from deformable_manipulation.scenario.spec import VoxelObstacle


@pytest.fixture
def voxels(mapping, tmp_path):
    tree = Tree()
    for x in range(10):
        tree.set((x, 0, 0), x == 4)
    (tmp_path / "map.bt").write_bytes(bt(tree, 0.1))
    obstacle = {"name": "map", "voxels": "map.bt", "unknown": "free", "translation": [3, 0, 0]}
    mapping["obstacles"] = [obstacle]
    return mapping


def read(mapping, tmp_path):
    return scenario_from_mapping(mapping, tmp_path).obstacles[0]


def distance(obstacle, *points):
    return MinimumDistance([obstacle], 0.0).compute(np.array(points)[None]).minimum[0]


def test_a_map_is_read_and_written(voxels, tmp_path):
    scenario = scenario_from_mapping(voxels, tmp_path)
    path = str(tmp_path / "map.bt")
    assert scenario.obstacles == (VoxelObstacle("map", path, "free", (3.0, 0.0, 0.0)),)
    assert scenario_from_mapping(scenario_to_mapping(scenario), "/nowhere") == scenario


def test_unknown_space_is_what_the_scenario_says(voxels, change, tmp_path):
    above = ((3.45, 0.05, 0.4), (3.45, 0.05, 0.5))
    in_free = ((3.15, 0.05, 0.05), (3.16, 0.05, 0.05))
    free = read(voxels, tmp_path)
    assert distance(free, *above) == pytest.approx(0.3)
    assert distance(free, *in_free) == pytest.approx(0.24)
    occupied = read(change(voxels, "obstacles.0.unknown", "occupied"), tmp_path)
    assert distance(occupied, *above) == pytest.approx(-np.hypot(0.4, 0.05), abs=2e-5)
    assert distance(occupied, *in_free) == pytest.approx(0.05)


def test_its_reach_its_description_and_its_drawing(voxels, change, tmp_path):
    free = read(voxels, tmp_path)
    np.testing.assert_allclose(np.ptp(obstacle_corners(free), axis=0), (0.1, 0.1, 0.1))
    assert free.endless == "" and free.description().endswith("map.bt, unknown space free")
    (marker,) = obstacle_markers([free], "map").markers
    (place,) = marker.points
    assert (marker.type, marker.scale.z) == (Marker.CUBE_LIST, 0.1)
    assert (place.x, place.y, place.z) == pytest.approx((3.45, 0.05, 0.05))
    occupied = read(change(voxels, "obstacles.0.unknown", "occupied"), tmp_path)
    np.testing.assert_allclose(np.ptp(obstacle_corners(occupied), axis=0), (1.0, 0.1, 0.1))
    assert "outside" in occupied.endless


@pytest.mark.parametrize(
    "key, value, told",
    [
        ("voxels", "nowhere.bt", "nowhere.bt"),
        ("voxels", 3, "must be the name of a map (OctoMap's .bt and .ot)"),
        ("unknown", "maybe", "must be one of free, occupied"),
        ("radius", 1, "is not a key here"),
    ],
)
def test_mistakes_are_told(voxels, change, problems_of, key, value, told):
    assert told in problems_of(change(voxels, "obstacles.0." + key, value))["obstacles.0." + key]


def test_what_is_unknown_must_be_said(voxels, problems_of):
    del voxels["obstacles"][0]["unknown"]
    assert "is missing; give one of free, occupied" in problems_of(voxels)["obstacles.0.unknown"]


@pytest.mark.parametrize(
    "unknown, state, told",
    [("free", False, "has no occupied cell"), ("occupied", True, "has no free cell")],
)
def test_maps_with_nothing_to_keep_off_or_nowhere_to_be(
    voxels, change, problems_of, tmp_path, unknown, state, told
):
    tree = Tree()
    tree.set((0, 0, 0), state)
    (tmp_path / "map.bt").write_bytes(bt(tree, 0.2))
    found = problems_of(change(voxels, "obstacles.0.unknown", unknown))
    assert told in found["obstacles.0.voxels"]
