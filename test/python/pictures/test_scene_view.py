"""A view that holds what there is to be seen."""

import numpy as np
import pytest
import yaml

from deformable_manipulation.pictures.scene_view import (
    fitted,
    plane_of,
    planned_bounds,
    scene_bounds,
)
from deformable_manipulation.ros.rviz_view import bare_view
from deformable_manipulation.scenario import load_scenario, package_share_directory

SIZE = (1280, 800)
BOUNDS = np.array([[19.0, -4.0, 2.0], [22.0, 3.0, 4.0]])


@pytest.fixture
def original():
    path = package_share_directory() / "rviz" / "rope_one_assistant.rviz"
    return yaml.safe_load(path.read_text())


def current(configuration):
    return configuration["Visualization Manager"]["Views"]["Current"]


def corners():
    return np.stack(np.meshgrid(*BOUNDS.T), axis=-1).reshape(-1, 3)


def in_picture(view, points):
    """Where an Orbit view shows points (N, 3), from -1 to 1 in both directions where visible."""
    yaw, pitch = view["Yaw"], view["Pitch"]
    back = np.array([np.cos(pitch) * np.cos(yaw), np.cos(pitch) * np.sin(yaw), np.sin(pitch)])
    eye = np.array([view["Focal Point"][axis] for axis in "XYZ"]) + view["Distance"] * back
    right = np.cross([0.0, 0.0, 1.0], back)
    right /= np.linalg.norm(right)
    up = np.cross(back, right)
    depth = (eye - points) @ back
    assert (depth > 0).all()
    half = np.tan(0.5 * view["Field of View"])
    across = (points - eye) @ right / (depth * half * SIZE[0] / SIZE[1])
    return np.stack((across, (points - eye) @ up / (depth * half)), axis=1)


@pytest.mark.parametrize("name", ["Perspective", "YZ"])
def test_an_orbit_shows_everything_and_little_else(original, name):
    result = fitted(bare_view(original, name, SIZE), BOUNDS, SIZE, "yz")
    places = np.abs(in_picture(current(result), corners()))
    assert 0.7 < places.max() < 0.9


def test_obstacles_in_another_plane_are_seen_from_its_side(original):
    result = fitted(bare_view(original, None, SIZE), BOUNDS, SIZE, "xz")
    view = current(result)
    places = in_picture(view, np.array([[19.0, 0.0, 3.0], [22.0, 0.0, 3.0]]))
    assert places[0, 0] < 0.0 < places[1, 0]  # +x to the right
    assert np.abs(in_picture(view, corners())).max() < 0.9
    (grid,) = [
        each for each in result["Visualization Manager"]["Displays"] if each["Class"] == "rviz/Grid"
    ]
    assert grid["Plane"] == "XZ" and grid["Offset"]["Y"] > BOUNDS[:, 1].mean()


def test_from_above(original):
    view = current(fitted(bare_view(original, "XY", SIZE), BOUNDS, SIZE, "yz"))
    assert (view["X"], view["Y"]) == (20.5, -0.5)
    # y goes to the right: 7 m, and x up: 3 m.
    assert 7.0 * view["Scale"] <= SIZE[0] and 3.0 * view["Scale"] <= SIZE[1]
    assert 7.0 * view["Scale"] > 0.7 * SIZE[0]


def test_the_original_stays_as_it_is(original):
    bare = bare_view(original, None, SIZE)
    before = yaml.safe_dump(bare)
    fitted(bare, BOUNDS, SIZE, "xz")
    assert yaml.safe_dump(bare) == before


def test_obstacles_count_where_they_are_near():
    scenario = load_scenario("rope_one_assistant")  # the ground reaches from y = -10 m to 20 m
    assert plane_of(scenario) == "yz"
    points = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 1.2]])
    low, high = scene_bounds(scenario, points, points)
    assert low[1] == pytest.approx(-0.6) and high[1] == pytest.approx(1.6)
    assert low[2] == pytest.approx(0.4) and high[2] == pytest.approx(1.2, abs=0.6)
    far = points + np.array([0.0, 0.0, 50.0])
    np.testing.assert_allclose(scene_bounds(scenario, far, far), [far.min(axis=0), far.max(axis=0)])


def test_a_scenario_that_has_not_been_run_is_seen_along_the_leaders_path():
    scenario = load_scenario("rope_one_assistant")
    low, high = planned_bounds(scenario)
    path = np.array([waypoint.position for waypoint in scenario.leader.waypoints])
    for agent in scenario.agents:
        way = agent.start + path
        assert (way >= low - 1e-9).all() and (way <= high + 1e-9).all()


def test_a_mesh_is_seen_where_it_stands():
    scenario = load_scenario("fabric_three_assistants")
    assert plane_of(scenario) is None
    cube = np.array([[0.5, 1.6, 0.5]])
    low, high = scene_bounds(scenario, cube, cube)
    assert (low <= cube).all() and (high >= cube).all() and (high - low > 0.5).all()
