"""Grips of several vertices, and leaders that turn, in scenario files: what is read and refused."""

import math

import pytest

from deformable_manipulation.scenario import scenario_from_mapping
from deformable_manipulation.scenario.mapping import scenario_to_mapping

HELPER = "agents.helper.further_particles"
HALF = [0.0, 0.0, math.sqrt(0.5), math.sqrt(0.5)]  # a quarter turn about z


@pytest.fixture
def bars(fabric_mapping, change):
    """A fabric between two bars along opposite edges."""
    for name, further in (("hand", [5, 10, 15, 20]), ("helper", [9, 14, 19, 24])):
        change(fabric_mapping, f"agents.{name}.further_particles", further)
    return fabric_mapping


@pytest.fixture
def turning(bars, change):
    """The same with a leader that turns, and an assistant that turns with it."""
    change(bars, "controller.orientation", "follow")
    change(bars, "controller.jacobian", "equilibrium")
    return change(bars, "leader.waypoints.1.orientation", HALF)


def test_further_particles_are_read_and_written(bars, tmp_path):
    scenario = scenario_from_mapping(bars, tmp_path)
    assert scenario.agents[1].particles == (4, 9, 14, 19, 24)
    again = scenario_from_mapping(scenario_to_mapping(scenario), tmp_path)
    assert again.agents == scenario.agents


def test_nobody_holds_further_particles_by_default(fabric_mapping, tmp_path):
    scenario = scenario_from_mapping(fabric_mapping, tmp_path)
    assert scenario.agents[1].further_particles == ()


@pytest.mark.parametrize(
    "value, expected",
    [
        ([9, 25], "has 25, which is no particle of the object: 0 to 24"),
        ([9, 9], "has 9 twice, or it is the particle itself"),
        ([4], "has 4 twice, or it is the particle itself"),
        ([9, 0], "has 0, which is already held by agent hand"),
        ([9, 20], "has 20, which is already held by agent hand"),
        (9, "must be a list"),
    ],
)
def test_particles_that_cannot_be_held(bars, change, problems_of, value, expected):
    found = problems_of(change(bars, HELPER, value))
    assert list(found) == [HELPER]
    assert expected in found[HELPER]


@pytest.mark.parametrize("value", [9.5, -1, "nine", None])
def test_particles_that_are_no_whole_numbers(bars, change, problems_of, value):
    found = problems_of(change(bars, HELPER, [14, value]))
    assert list(found) == [HELPER + ".1"]
    assert "a whole number from 0" in found[HELPER + ".1"]


def test_a_particle_that_another_one_s_bar_holds(bars, change, problems_of):
    found = problems_of(change(bars, "agents.helper.particle", 20))
    assert "has 20, which is already held by agent helper" in found["agents.hand.further_particles"]


def test_grips_of_several_particles_are_clamped(bars, change, problems_of):
    found = problems_of(change(bars, "agents.helper.hold", "pinned"))
    assert "must be clamped with further_particles" in found["agents.helper.hold"]


def test_rods_have_grips_of_one_segment(mapping, change, problems_of):
    found = problems_of(change(mapping, HELPER, [8]))
    assert "a clamped segment of a rod keeps its orientation" in found[HELPER]


def test_bars_whose_ends_are_farther_apart_than_the_fabric_reaches(bars, change, problems_of):
    """Their middles are not."""
    angle = -0.25
    turned = [0.0, 0.0, math.sin(angle), math.cos(angle)]
    found = problems_of(change(bars, "agents.helper.orientation", turned))
    text = found["agents.helper.start"]
    assert "puts particles" in text
    assert "beyond the free length" in text


def test_a_leader_turns_with_followers(turning, tmp_path):
    scenario = scenario_from_mapping(turning, tmp_path)
    assert scenario.leader.waypoints[1].is_turned
    assert not scenario.leader.waypoints[0].is_turned
    again = scenario_from_mapping(scenario_to_mapping(scenario), tmp_path)
    assert again.leader == scenario.leader


@pytest.mark.parametrize(
    "key, value, where, expected",
    [
        ("agents.helper.further_particles", [], "controller.orientation", "one vertex of a fabric"),
        ("agents.hand.further_particles", [], "controller.orientation", "cannot turn it: hand"),
        ("controller.jacobian", "perturbed_copies", "controller.orientation", "equilibrium"),
        (
            "controller.orientation",
            "fixed",
            "leader.waypoints.1.orientation",
            "must be [0, 0, 0, 1] with controller.orientation: fixed",
        ),
        (
            "knowledge.pose_noise",
            0.001,
            "leader.waypoints.1.orientation",
            "must be [0, 0, 0, 1] with imperfect knowledge",
        ),
        (
            "leader.waypoints.0.orientation",
            HALF,
            "leader.waypoints.0.orientation",
            "relative to the leader's start",
        ),
        (
            "leader.waypoints.1.time",
            0.3,
            "leader.waypoints.1.orientation",
            "at most 1.2 rad from the waypoint before, 4 rad/s in 0.3 s",
        ),
        (
            "leader.waypoints.1.orientation",
            [0.0, 0.0, 1.0, 1.0],
            "leader.waypoints.1.orientation",
            "a quaternion",
        ),
    ],
)
def test_turns_that_cannot_be(turning, change, problems_of, key, value, where, expected):
    found = problems_of(change(turning, key, value))
    assert expected in found[where]


def test_torque_is_limited_where_a_grip_holds_several_vertices(bars, change, problems_of, tmp_path):
    limit = {"max_torque": 3.0}
    change(bars, "controller.grip_torque", limit)
    assert scenario_from_mapping(bars, tmp_path).controller.grip_torque.max_torque == 3.0
    for agent in ("hand", "helper"):
        change(bars, f"agents.{agent}.further_particles", [])
    assert "a single one exerts no torque" in problems_of(bars)["controller.grip_torque"]
