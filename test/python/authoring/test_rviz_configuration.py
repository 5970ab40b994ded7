"""The configurations of the shipped scenarios are made by the command, and show the whole run."""

import numpy as np
import pytest
import yaml

from deformable_manipulation.authoring.rviz_configuration import rviz_configuration
from deformable_manipulation.commands.rviz_configuration import main
from deformable_manipulation.scenario import load_scenario, package_share_directory

SHARE = package_share_directory()
NAMES = sorted(path.stem for path in (SHARE / "config" / "scenarios").glob("*.yaml"))
WIDTH, HEIGHT = 1280, 800


@pytest.fixture(scope="module", params=NAMES)
def scenario(request):
    return load_scenario(request.param)


@pytest.fixture(scope="module")
def manager(scenario):
    return rviz_configuration(scenario)["Visualization Manager"]


@pytest.fixture(scope="module")
def places(scenario):
    """Where the agents are to be (N, 3) [m]."""
    starts = np.array([agent.start for agent in scenario.agents])
    path = np.array([waypoint.position for waypoint in scenario.leader.waypoints])
    return (starts[:, None] + path).reshape(-1, 3)


def test_the_file_is_what_the_command_prints(scenario, capsys):
    assert main([scenario.name]) == 0
    path = SHARE / "rviz" / f"{scenario.name}.rviz"
    assert path.read_text() == capsys.readouterr().out


def test_a_wrong_scenario_is_told(tmp_path, capsys):
    path = tmp_path / "wrong.yaml"
    path.write_text("object: 3\n")
    assert main([str(path)]) == 1
    assert "object" in capsys.readouterr().err


def view(manager, name):
    (found,) = [each for each in manager["Views"]["Saved"] if each["Name"] == name]
    return found


def point(mapping):
    return np.array([mapping[axis] for axis in "XYZ"])


@pytest.mark.parametrize("name", ["Perspective", "YZ"])
def test_an_orbit_view_holds_all_places(manager, places, name):
    orbit = view(manager, name)
    pitch, yaw = orbit["Pitch"], orbit["Yaw"]
    back = np.array((np.cos(yaw) * np.cos(pitch), np.sin(yaw) * np.cos(pitch), np.sin(pitch)))
    right = np.array((-np.sin(yaw), np.cos(yaw), 0.0))
    up = np.cross(back, right)
    from_camera = places - (point(orbit["Focal Point"]) + orbit["Distance"] * back)
    depth = -from_camera @ back
    assert (depth > orbit["Near Clip Distance"]).all()
    half = np.tan(0.5 * orbit["Field of View"]) * depth
    assert (np.abs(from_camera @ up) < 0.95 * half).all()
    assert (np.abs(from_camera @ right) < 0.95 * half * WIDTH / HEIGHT).all()


def test_the_view_from_above_holds_all_places(manager, places):
    top = view(manager, "XY")
    along = np.abs(places[:, 1] - top["Y"]) * top["Scale"]
    across = np.abs(places[:, 0] - top["X"]) * top["Scale"]
    assert (along < 0.48 * WIDTH).all() and (across < 0.48 * HEIGHT).all()


def test_markers_can_be_dragged_at_once(manager):
    displays = {display["Class"]: display for display in manager["Displays"]}
    assert displays["rviz/InteractiveMarkers"]["Enabled"]
    assert displays["rviz/InteractiveMarkers"]["Update Topic"] == "interactive_markers/update"
    assert manager["Tools"][0]["Class"] == "rviz/Interact"  # the first is the one in the hand


def test_the_text_is_free_of_aliases(scenario):
    text = (SHARE / "rviz" / f"{scenario.name}.rviz").read_text()
    assert "&id" not in text and yaml.safe_load(text) == rviz_configuration(scenario)


def test_the_axes_of_grips_that_turn_are_shown_beyond_the_balls(scenario, manager):
    (axes,) = [each for each in manager["Displays"] if each["Class"] == "rviz/TF"]
    assert axes["Enabled"] == axes["Value"] == scenario.controller.turns
    assert 0.2 * axes["Marker Scale"] > 2 * 0.07  # m, of RViz's axes, and the balls at the grips
    assert axes["Frames"][scenario.frame] == {"Value": False}
