"""Sections that are right by themselves and wrong together."""

import pytest

from deformable_manipulation.scenario import scenario_from_mapping


def test_time_step_that_does_not_divide_the_cycle(mapping, change, problems_of, tmp_path):
    text = problems_of(change(mapping, "simulation.time_step", 0.008))["simulation.time_step"]
    assert "0.00666666667 or 0.01" in text
    for allowed in (0.00666666667, 0.01):
        change(mapping, "simulation.time_step", allowed)
        scenario_from_mapping(mapping, tmp_path)


def test_time_step_beyond_the_cycle(mapping, change, problems_of):
    text = problems_of(change(mapping, "simulation.time_step", 0.03))["simulation.time_step"]
    assert "nearest: 0.02" in text


@pytest.mark.parametrize(
    "key, value, expected",
    [
        ("controller.gain", 50.0, "below controller.rate (50 Hz)"),
        ("controller.collision.alpha", [1.0, 60.0], "below controller.rate"),
        ("controller.collision.anticipation", [60.0, 1.0], "below controller.rate"),
        ("controller.overstretch.alpha", [60.0, 1.0], "below controller.rate"),
        ("controller.proximity.alpha", [60.0, 1.0], "below controller.rate"),
        ("controller.timeout", 0.01, "at least one cycle, 1 / controller.rate = 0.02 s"),
        ("simulation.duration", 0.01, "at least one controller cycle, 0.02 s"),
        ("simulation.record_rate", 51.0, "at most controller.rate (50 Hz)"),
        ("controller.perturbation", [0.1, -1.9, 0.1], "shortest free length"),
        ("controller.overstretch.max_distance", 1.81, "at most the free length between hand"),
        ("controller.proximity.min_distance", 1.79, "below the maximum distance"),
    ],
)
def test_values_that_do_not_fit(mapping, change, problems_of, key, value, expected):
    found = problems_of(change(mapping, key, value))
    assert list(found) == [key]
    assert expected in found[key]


def test_agents_further_apart_than_the_object_reaches(mapping, change, problems_of):
    found = problems_of(change(mapping, "agents.helper.start", [0.0, 1.9, 1.0]))
    assert list(found) == ["agents.helper.start"]
    assert "1.9 m from hand, beyond the free length 1.8 m" in found["agents.helper.start"]


def test_undeformed_object_is_beyond_the_maximum_distance_only(mapping, problems_of):
    for agent in mapping["agents"].values():
        del agent["start"]
    text = problems_of(mapping)["agents.helper.start"]
    assert "beyond their maximum distance 1.782 m" in text
    assert "free length" not in text


def test_agents_that_start_too_close(mapping, change, problems_of):
    found = problems_of(change(mapping, "agents.helper.start", [0.0, 0.1, 1.0]))
    assert "0.1 m from hand, below their minimum distance 0.18 m" in found["agents.helper.start"]


def test_every_pair_is_checked(mapping, problems_of):
    mapping["agents"]["third"] = {"particle": 5, "role": "assistant", "start": [0.0, 0.2, 1.0]}
    # 4 segments of 0.2 m lie between third and helper, which are 1.3 m apart.
    text = problems_of(mapping)["agents.third.start"]
    assert "1.3 m from helper, beyond the free length 0.8 m" in text


def test_independent_checks_are_reported_together(mapping, change, problems_of):
    change(mapping, "agents.helper.start", [0.0, 1.9, 1.0])
    change(mapping, "simulation.time_step", 0.03)
    change(mapping, "controller.gain", 70.0)
    change(mapping, "leader.waypoints.0.time", 1.0)
    assert set(problems_of(mapping)) == {
        "agents.helper.start",
        "simulation.time_step",
        "controller.gain",
        "leader.waypoints.0.time",
    }


def test_the_papers_formulation_brings_its_values(mapping, change, tmp_path):
    controller = scenario_from_mapping(
        change(mapping, "controller.formulation", "paper"), tmp_path
    ).controller
    assert (controller.differences, controller.feedforward) == ("forward", False)
    assert controller.collision.gradient == "minimum"
    margins = [controller.collision, controller.overstretch, controller.proximity]
    assert [section.margin for section in margins] == [0.0, 0.0, 0.0]
    assert controller.collision.offset == mapping["controller"]["collision"]["offset"]


@pytest.mark.parametrize(
    "key, value, wanted",
    [
        ("controller.differences", "central", "forward"),
        ("controller.feedforward", True, "false"),
        ("controller.jacobian", "equilibrium", "perturbed_copies"),
        ("controller.collision.gradient", "features", "minimum"),
        ("controller.overstretch.margin", 0.01, "0.0"),
    ],
)
def test_the_papers_formulation_takes_no_others(mapping, change, problems_of, key, value, wanted):
    change(mapping, "controller.formulation", "paper")
    found = problems_of(change(mapping, key, value))
    assert list(found) == [key]
    assert f"must be {wanted} with controller.formulation: paper" in found[key].replace("'", "")
