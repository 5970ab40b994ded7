"""Clouds in the scenario."""

import numpy as np
import pytest
from visualization_msgs.msg import Marker

from deformable_manipulation.distance.minimum_distance import MinimumDistance
from deformable_manipulation.obstacles.spec import obstacle_corners
from deformable_manipulation.ros import obstacle_markers
from deformable_manipulation.scenario import scenario_from_mapping, scenario_to_mapping
from deformable_manipulation.scenario.spec import CloudObstacle

POINTS = np.array([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 2.0, 0.5)])


@pytest.fixture
def cloud(mapping, tmp_path):
    np.save(tmp_path / "scan.npy", POINTS)
    obstacle = {"name": "scan", "cloud": "scan.npy", "radius": 0.1, "translation": [3, 0, 0]}
    mapping["obstacles"] = [obstacle]
    return mapping


@pytest.fixture
def obstacle(cloud, tmp_path):
    return scenario_from_mapping(cloud, tmp_path).obstacles[0]


def test_a_cloud_is_read_and_written(cloud, tmp_path):
    scenario = scenario_from_mapping(cloud, tmp_path)
    path = str(tmp_path / "scan.npy")
    assert scenario.obstacles == (CloudObstacle("scan", path, 0.1, (3.0, 0.0, 0.0)),)
    resolved = scenario_to_mapping(scenario)
    assert scenario_from_mapping(resolved, "/nowhere") == scenario
    resolved["obstacles"][0]["cloud"] = "/nowhere/scan.npy"
    assert scenario_from_mapping(resolved, "/nowhere", files_are_read=True)


def test_its_distance_its_reach_and_its_description(obstacle):
    line = np.array([(4.0, 3.0, 0.5), (4.0, 4.0, 0.5)])
    assert MinimumDistance([obstacle], 0.0).compute(line[None]).minimum[0] == pytest.approx(0.9)
    corners = obstacle_corners(obstacle)
    np.testing.assert_allclose(corners.min(axis=0), (2.9, -0.1, -0.1))
    np.testing.assert_allclose(corners.max(axis=0), (4.1, 2.1, 0.6))
    assert obstacle.description().endswith("scan.npy, radius 0.1 m")


def test_an_origin_is_taken_off(cloud, change, tmp_path):
    change(cloud, "obstacles.0.origin", [1, 0, 0])
    (moved,) = scenario_from_mapping(cloud, tmp_path).obstacles
    np.testing.assert_allclose(obstacle_corners(moved).min(axis=0), (1.9, -0.1, -0.1))


def test_it_is_drawn_as_balls_and_not_too_many(obstacle, monkeypatch):
    (marker,) = obstacle_markers.obstacle_markers([obstacle], "map").markers
    places = [(p.x, p.y, p.z) for p in marker.points]
    assert (marker.type, marker.scale.x, marker.color.a) == (Marker.SPHERE_LIST, 0.2, 1.0)
    np.testing.assert_allclose(places, POINTS + (3.0, 0.0, 0.0))
    monkeypatch.setattr(obstacle_markers, "_MOST_DOTS", 2)
    (marker,) = obstacle_markers.obstacle_markers([obstacle], "map").markers
    assert len(marker.points) == 2


@pytest.mark.parametrize(
    "key, value, told",
    [
        ("cloud", "nowhere.pcd", "nowhere.pcd"),
        ("cloud", 3, "must be the name of a file of points (PCD, PLY, XYZ"),
        ("radius", -1, "must be a number >= 0"),
        ("plane", "xy", "is not a key here"),
        ("mesh", "cube.obj", "cannot be combined with mesh"),
    ],
)
def test_mistakes_are_told(cloud, change, problems_of, key, value, told):
    found = problems_of(change(cloud, "obstacles.0." + key, value))
    assert any(told in text for text in found.values()), found


def test_a_cloud_without_a_radius(cloud, problems_of):
    del cloud["obstacles"][0]["radius"]
    assert "is missing; give a number" in problems_of(cloud)["obstacles.0.radius"]
