"""Live obstacles, the camera, and obstacles that are not known or not real: keys and mistakes."""

import dataclasses
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from deformable_manipulation.commands import run_scenario
from deformable_manipulation.distance.factory import make_known_distance, make_minimum_distance
from deformable_manipulation.running.inspection import inspect_scenario
from deformable_manipulation.scenario import ScenarioError, load_scenario, scenario_from_mapping
from deformable_manipulation.scenario.mapping import scenario_to_mapping

CAMERA = "rope_over_depth_camera"
EXAMPLES = Path(__file__).resolve().parents[3] / "examples"


@pytest.mark.parametrize("name", [CAMERA, "fabric_over_octomap"])
def test_the_resolved_scenario_is_the_same(name):
    scenario = load_scenario(name)
    assert scenario_from_mapping(scenario_to_mapping(scenario), ".") == scenario


def problems(*overrides):
    with pytest.raises(ScenarioError) as caught:
        load_scenario(CAMERA, overrides)
    return str(caught.value)


@pytest.mark.parametrize(
    "override, complaint",
    [
        (("obstacles.1.live_cloud", "2points"), "must be a ROS topic"),
        (("obstacles.1.radius", "-1"), "obstacles.1.radius: -1"),
        (("obstacles.1.timeout", "0"), "must be a number > 0"),
        (("obstacles.1.hold", "6"), "must be a number >= 0 and <= 5"),
        (("obstacles.1.least_points", "-1"), "a whole number from 0"),
        (("obstacles.1.translation", "[0, 0, 1]"), "is not a key here"),
        (("obstacles.1.leave_out.object", "0.05"), "must be below controller.collision.offset"),
        (
            ("obstacles.1.leave_out.shapes", "[{frame: arm, start: [0, 0, 0]}]"),
            "radius: is missing",
        ),
        (("obstacles.1.least_points", "60000"), "must be at most 51200, the pixels of the camera"),
        (("obstacles.1.timeout", "0.05"), "must be above 0.0666667 s, the time from one image"),
        (("obstacles.0.real", "false"), "must not be false where known is, too"),
        (("camera.rate", "200"), "must be at most controller.rate (100 Hz)"),
        (("camera.target", "[1.9, 1.75, 0]"), "must not be straight above or below"),
        (("camera.farthest", "0.2"), "must be above nearest, 0.3 m"),
        (("camera.frame", "map"), "must not be the fixed frame"),
        (("camera.width", "4"), "a whole number from 8"),
        (("knowledge.pose_noise", "0.001"), "cannot be combined with obstacles that are live"),
    ],
)
def test_mistakes(override, complaint):
    assert complaint in problems(override)


def test_the_camera_shows_points_of_surfaces_alone():
    field = "{name: map, live_field: camera/points, spacing: 0.05, unknown: free}"
    complaint = problems(("obstacles.1", field))
    assert "obstacles.1.live_field" in complaint and "use live_cloud" in complaint


def test_every_mistake_is_found_at_once():
    text = problems(("camera.rate", "200"), ("obstacles.1.leave_out.object", "0.05"))
    assert "2 mistakes" in text


def test_what_is_near_the_grips_and_not_seen_is_told():
    assert not inspect_scenario(load_scenario(CAMERA)).warnings
    scenario = load_scenario(CAMERA, [("obstacles.1.leave_out.grips", "0.06")])
    (warning,) = inspect_scenario(scenario).warnings
    assert "What is nearer to a held point is not seen" in warning


def minima(scenario, points):
    return [
        float(make(scenario).compute(points).minimum[0])
        for make in (make_minimum_distance, make_known_distance)
    ]


def test_what_is_really_there_and_what_is_known():
    scenario = load_scenario("fabric_over_octomap")
    points = np.zeros((1, 225, 3)) + (0.0, 1.6, 3.0)
    real, known = minima(scenario, points)
    assert real == pytest.approx(3.0 - 1.0 - 0.005, abs=0.01)  # over the dome and the chimney
    assert known == pytest.approx(3.0 - 1.05 - 0.005, abs=1e-6)  # a cell higher
    everything = tuple(
        dataclasses.replace(each, known=True, real=True) for each in scenario.obstacles
    )
    both = minima(dataclasses.replace(scenario, obstacles=everything), points)
    assert both == [known, known]


def test_a_run_without_ros_tells_what_is_not_there(tmp_path, capsys):
    options = ["--set", "obstacles.1.live_cloud=elsewhere", "--set", "simulation.duration=0.1"]
    assert run_scenario.main([CAMERA, "--output", str(tmp_path / "run"), *options]) == 0
    assert "nothing is there of obstacle 'seen': its data come from ROS" in capsys.readouterr().err


def test_the_map_of_the_machine_is_what_its_example_makes(tmp_path):
    script = EXAMPLES / "octomap_of_obstacles.py"
    subprocess.run([sys.executable, str(script), str(tmp_path)], check=True, stdout=subprocess.PIPE)
    committed = Path(load_scenario("fabric_over_octomap").obstacles[0].voxels)
    assert (tmp_path / "machine.bt").read_bytes() == committed.read_bytes()
