"""Values set from outside the file."""

import pytest
import yaml

from deformable_manipulation.scenario import ScenarioError, load_scenario


@pytest.fixture
def path(mapping, tmp_path):
    path = tmp_path / "small.yaml"
    path.write_text(yaml.safe_dump(mapping, sort_keys=False))
    return path


def refusal(path, *overrides):
    with pytest.raises(ScenarioError) as caught:
        load_scenario(path, overrides)
    return "\n".join(map(str, caught.value.problems))


def test_values_are_replaced(path):
    scenario = load_scenario(
        path,
        [
            ("leader.waypoints.1.time", "3"),
            ("agents.hand.particle", "1"),
            ("agents.hand.start", "[0, 0.2, 1]"),
            ("controller.overstretch", "{max_distance: 1.5}"),
            ("controller.gain", "3.0e0"),
        ],
    )
    assert scenario.leader.waypoints[1].time == 3.0
    assert scenario.agents[0].particle == 1
    assert scenario.agents[0].start == (0.0, 0.2, 1.0)
    assert scenario.controller.overstretch.max_distance == 1.5
    assert scenario.controller.gain == 3.0


def test_sections_the_file_leaves_out_are_made(path):
    scenario = load_scenario(path, [("controller.proximity.min_distance", "0.3")])
    assert scenario.controller.proximity.min_distance == 0.3


def test_a_whole_agent_can_be_added(path):
    agent = "{particle: 4, role: assistant, start: [0, 0.7, 1]}"
    assert load_scenario(path, [("agents.second", agent)]).agents[2].name == "second"


def test_the_last_of_two_values_counts(path):
    overrides = [("controller.gain", "3"), ("controller.gain", "4")]
    assert load_scenario(path, overrides).controller.gain == 4.0


def test_aliases_in_the_file_are_not_changed_together(mapping, tmp_path):
    origin = [0.0, 0.0, 0.0]
    mapping["leader"]["waypoints"][0]["position"] = origin
    mapping["leader"]["waypoints"][1]["position"] = origin
    path = tmp_path / "aliases.yaml"
    path.write_text(yaml.safe_dump(mapping))
    assert "&id001" in path.read_text()
    waypoints = load_scenario(path, [("leader.waypoints.1.position.2", "0.5")]).leader.waypoints
    assert [w.position[2] for w in waypoints] == [0.0, 0.5]


@pytest.mark.parametrize(
    "key, value, expected",
    [
        ("controler.a", "1", "controler: is not a key here; did you mean 'controller'"),
        ("controller.gian", "1", "did you mean 'gain'?"),
        ("leader.waypoints.2.time", "1", "list of 2; name an item by its index, 0 to 1"),
        ("leader.waypoints.-1.time", "1", "name an item by its index"),
        ("leader.waypoints.last.time", "1", "name an item by its index"),
        ("agents.helpr.particle", "1", "there is no agent 'helpr'; did you mean 'helper'?"),
        ("controller.rate.x", "1", "controller.rate is 50.0, which has no keys"),
        ("controller.gain", "[1", "not valid YAML"),
        ("controller.gain", "{[1]: 2}", "a list or a section stands where a key is needed"),
        ("controller.gain", "fast", "controller.gain: 'fast' \u2014 must be a number > 0"),
        ("", "1", "is not a key"),
    ],
)
def test_refused(path, key, value, expected):
    assert expected in refusal(path, (key, value))


def test_problems_of_overridden_values_tell_no_line_of_the_file(path):
    assert "(line" not in refusal(path, ("controller.gain", "-1"))


def test_all_refusals_at_once(path):
    text = refusal(path, ("controller.rate.x", "1"), ("controller.gain", "-1"), ("nme", "x"))
    assert len(text.splitlines()) == 3
