"""Fields of distances in the scenario."""

import numpy as np
import pytest
from visualization_msgs.msg import Marker

from deformable_manipulation.distance.minimum_distance import MinimumDistance
from deformable_manipulation.obstacles.spec import obstacle_corners
from deformable_manipulation.ros.obstacle_markers import obstacle_markers
from deformable_manipulation.scenario import scenario_from_mapping, scenario_to_mapping
from deformable_manipulation.scenario.spec import FieldObstacle


@pytest.fixture
def field(mapping, tmp_path):
    """Ground below z = 0 in a box of 2 m x 2 m x 1 m."""
    heights = np.broadcast_to(np.linspace(-0.5, 0.5, 6), (6, 6, 6))
    arrays = {"distances": heights, "origin": np.array((-1.0, -1.0, -0.5))}
    np.savez(tmp_path / "field.npz", spacing=np.array((0.4, 0.4, 0.2)), **arrays)
    obstacle = {"name": "ground", "field": "field.npz", "unknown": "free"}
    mapping["obstacles"] = [{**obstacle, "translation": [0, 0, 2]}]
    return mapping


def read(mapping, tmp_path):
    return scenario_from_mapping(mapping, tmp_path).obstacles[0]


def distance(obstacle, *points):
    return MinimumDistance([obstacle], 0.0).compute(np.array(points)[None]).minimum[0]


def test_a_field_is_read_and_written(field, tmp_path):
    scenario = scenario_from_mapping(field, tmp_path)
    path = str(tmp_path / "field.npz")
    assert scenario.obstacles == (FieldObstacle("ground", path, "free", (0.0, 0.0, 2.0)),)
    assert scenario_from_mapping(scenario_to_mapping(scenario), "/nowhere") == scenario


def test_unknown_space_is_what_the_scenario_says(field, change, tmp_path):
    above = ((0.0, 0.0, 2.3), (0.1, 0.0, 2.3))
    higher = ((0.0, 0.0, 2.9), (0.1, 0.0, 2.9))
    free = read(field, tmp_path)
    assert distance(free, *above) == pytest.approx(0.3, abs=1e-6)
    assert distance(free, *higher) == pytest.approx(np.hypot(0.5, 0.4), abs=1e-6)
    occupied = read(change(field, "obstacles.0.unknown", "occupied"), tmp_path)
    assert distance(occupied, *above) == pytest.approx(0.2, abs=1e-6)
    assert distance(occupied, *higher) == pytest.approx(-0.4, abs=1e-6)


def test_its_reach_its_description_and_its_drawing(field, tmp_path):
    obstacle = read(field, tmp_path)
    np.testing.assert_allclose(obstacle_corners(obstacle).min(axis=0), (-1.0, -1.0, 1.5))
    np.testing.assert_allclose(obstacle_corners(obstacle).max(axis=0), (1.0, 1.0, 2.5))
    assert obstacle.description().endswith("field.npz, unknown space free")
    (marker,) = obstacle_markers([obstacle], "map").markers
    assert marker.type == Marker.CUBE_LIST and len(marker.points) == 36
    assert {round(point.z, 6) for point in marker.points} == {1.9}


def test_values_that_are_not_known_are_told(field, change, tmp_path):
    arrays = dict(np.load(tmp_path / "field.npz"))
    arrays["distances"] = np.where(arrays["distances"] > 0.4, np.nan, arrays["distances"])
    np.savez(tmp_path / "field.npz", **arrays)
    obstacle = read(field, tmp_path)
    (warning,) = MinimumDistance([obstacle], 0.0).warnings
    assert warning == "obstacle 'ground': 36 of 216 distances are nan: they count as free"


@pytest.mark.parametrize(
    "key, value, told",
    [
        ("field", "nowhere.npz", "nowhere.npz"),
        ("field", 3, "must be the name of an archive of NumPy"),
        ("unknown", True, "must be one of free, occupied"),
        ("scale", 2, "is not a key here"),
    ],
)
def test_mistakes_are_told(field, change, problems_of, key, value, told):
    assert told in problems_of(change(field, "obstacles.0." + key, value))["obstacles.0." + key]
