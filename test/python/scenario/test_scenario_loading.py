"""What a correct scenario becomes, and where files are found."""

import math
import os
from pathlib import Path

import pytest
import yaml

from deformable_manipulation.scenario import (
    ScenarioError,
    load_scenario,
    pair_limits,
    scenario_from_mapping,
)
from deformable_manipulation.scenario.spec import CollisionSpec, ControllerSpec

SQUARE = "y,z\n0,0\n1,0\n1,1\n0,1\n"


def write_scenario(path, mapping):
    path.write_text(yaml.safe_dump(mapping, sort_keys=False), encoding="utf-8")
    return path


def test_absent_keys_take_the_defaults_of_the_spec(mapping, tmp_path):
    mapping["controller"] = {"collision": {"offset": 0.1}}
    scenario = scenario_from_mapping(mapping, tmp_path)
    priority = ("collision", "overstretch", "proximity")
    wanted = ControllerSpec(collision=CollisionSpec(offset=0.1), priority=priority)
    assert scenario.controller == wanted
    assert scenario.frame == "map"


def test_agents_keep_the_order_of_the_file(mapping, tmp_path):
    mapping["agents"] = dict(reversed(list(mapping["agents"].items())))
    scenario = scenario_from_mapping(mapping, tmp_path)
    assert [agent.name for agent in scenario.agents] == ["helper", "hand"]
    assert scenario.leader_index == 1


def test_start_and_orientation_default_to_the_undeformed_object(mapping, tmp_path):
    del mapping["agents"]["hand"]["start"]
    mapping["agents"]["helper"]["start"] = [0.5, 0.5, 1.0]
    hand = scenario_from_mapping(mapping, tmp_path).agents[0]
    # [0, 0, 0.6, 0.8] turns the x axis about z; the first segment's centre is at 0.1 m.
    angle = 2.0 * math.asin(0.6)
    assert hand.start == pytest.approx((0.1 * math.cos(angle), 0.1 * math.sin(angle), 1.0))
    assert hand.orientation == (0.0, 0.0, 0.6, 0.8)


def test_numbers_in_strings_and_integral_floats_are_accepted(mapping, change, tmp_path):
    change(mapping, "object.young_modulus", "30.0e6")
    change(mapping, "object.segments", 10.0)
    change(mapping, "simulation.substeps", "4")
    change(mapping, "controller.gain", 2)
    scenario = scenario_from_mapping(mapping, tmp_path)
    assert scenario.object.young_modulus == 3.0e7
    assert (scenario.object.segments, scenario.simulation.substeps) == (10, 4)
    assert isinstance(scenario.object.segments, int)
    assert isinstance(scenario.controller.gain, float)


def test_quaternions_near_unit_norm_are_normalised(mapping, change, tmp_path):
    change(mapping, "object.pose.orientation", [0.0, 0.0, 0.7071, 0.7071])
    orientation = scenario_from_mapping(mapping, tmp_path).object.pose.orientation
    assert math.fsum(c * c for c in orientation) == pytest.approx(1.0, abs=1e-15)


@pytest.mark.parametrize("obstacles", [None, [], "absent"])
def test_a_scenario_without_obstacles(mapping, tmp_path, obstacles):
    mapping["obstacles"] = obstacles
    if obstacles == "absent":
        del mapping["obstacles"]
    assert scenario_from_mapping(mapping, tmp_path).obstacles == ()


def test_pair_limits_auto_follow_the_free_length(mapping, tmp_path):
    scenario = scenario_from_mapping(mapping, tmp_path)
    limits = pair_limits(scenario, 0, 1)
    assert limits.max_distance == pytest.approx(0.99 * 1.8)
    assert limits.min_distance == pytest.approx(0.10 * 1.8)
    assert pair_limits(scenario, 1, 0) == limits


def test_pair_limits_given_in_the_file(mapping, change, tmp_path):
    change(mapping, "controller.overstretch.max_distance", 1.7)
    change(mapping, "controller.proximity.min_distance", "auto")
    limits = pair_limits(scenario_from_mapping(mapping, tmp_path), 0, 1)
    assert (limits.max_distance, limits.min_distance) == (1.7, pytest.approx(0.18))


def test_name_defaults_to_the_file(mapping, tmp_path):
    del mapping["name"]
    assert load_scenario(write_scenario(tmp_path / "my run.yaml", mapping)).name == "my run"


def test_polygon_files_are_relative_to_the_scenario(mapping, change, tmp_path, monkeypatch):
    (tmp_path / "shapes").mkdir()
    (tmp_path / "shapes" / "square.csv").write_text(SQUARE)
    change(mapping, "obstacles.0.polygon", "../shapes/square.csv")
    (tmp_path / "scenarios").mkdir()
    path = write_scenario(tmp_path / "scenarios" / "x.yaml", mapping)
    monkeypatch.chdir(tmp_path / "scenarios")
    for given in (path, Path("x.yaml")):
        assert load_scenario(given).obstacles[0].points == ((0, 0), (1, 0), (1, 1), (0, 1))


def test_polygon_files_of_this_package(mapping, change, tmp_path):
    change(
        mapping,
        "obstacles.0.polygon",
        "package://deformable_manipulation/config/obstacles/ground.csv",
    )
    assert len(scenario_from_mapping(mapping, tmp_path).obstacles[0].points) == 86


def test_polygon_files_of_an_unknown_package(mapping, change, problems_of):
    change(mapping, "obstacles.0.polygon", "package://no_such_package_here/ground.csv")
    assert "no_such_package_here" in problems_of(mapping)["obstacles.0.polygon"]


def test_scenario_by_its_bare_name(tmp_path, monkeypatch):
    (tmp_path / "rope_one_assistant").mkdir()  # an output folder does not hide the scenario
    monkeypatch.chdir(tmp_path)
    assert load_scenario("rope_one_assistant").name == "rope_one_assistant"


def test_unknown_bare_name_lists_the_scenarios():
    with pytest.raises(ScenarioError) as caught:
        load_scenario("rope_one_asistant")
    assert "did you mean 'rope_one_assistant'?" in str(caught.value)


def test_what_is_no_regular_file_is_refused(tmp_path):
    os.mkfifo(str(tmp_path / "pipe.yaml"))
    for path in (tmp_path / "pipe.yaml", "/dev/zero"):
        with pytest.raises(ScenarioError, match="not a regular file"):
            load_scenario(path)


def test_a_folder_is_refused(tmp_path):
    with pytest.raises(ScenarioError, match="is a folder; name a scenario file"):
        load_scenario(tmp_path)


def test_a_name_too_long_for_a_file():
    with pytest.raises(ScenarioError, match="no such file"):
        load_scenario("a" * 300)


def test_missing_file(tmp_path):
    with pytest.raises(ScenarioError) as caught:
        load_scenario(tmp_path / "absent.yaml")
    assert "absent.yaml" in str(caught.value)
    assert "no such file" in str(caught.value)
