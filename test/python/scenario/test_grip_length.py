"""Lengths of grips: how they divide a rod, what else follows from that, and what is refused."""

import numpy as np
import pytest

from deformable_manipulation.objects.body import make_body
from deformable_manipulation.scenario import (
    ScenarioError,
    load_scenario,
    scenario_from_mapping,
    scenario_to_mapping,
)
from deformable_manipulation.scenario.limits import pair_limits
from deformable_manipulation.simulation.factory import make_simulation

ROPE = "rope_one_assistant"
BOTH = ("agents.leader.grip_length=0.02", "agents.assistant_1.grip_length=0.02")


def loaded(*overrides, name=ROPE):
    return load_scenario(name, [tuple(each.split("=", 1)) for each in overrides])


def test_without_the_key_all_segments_are_as_long():
    spec = loaded().object
    assert spec.grips == () and spec.has_equal_segments
    assert set(spec.segment_lengths) == {spec.length / spec.segments}
    auto = loaded("agents.leader.grip_length=auto", "agents.assistant_1.grip_length=auto")
    assert auto.object == spec


def test_segments_next_to_a_grip_are_shorter():
    scenario = loaded(*BOTH)
    spec = scenario.object
    lengths = np.array(spec.segment_lengths)
    assert lengths.sum() == pytest.approx(spec.length, abs=1e-12)
    assert lengths[0] - lengths[1] == pytest.approx(0.02, abs=1e-12)
    assert np.all(np.diff(lengths[1:14]) >= -1e-12)
    assert lengths[1] < 0.3 * spec.length / spec.segments
    points = make_body(spec).points()[0]
    np.testing.assert_allclose(np.linalg.norm(np.diff(points, axis=0), axis=1), lengths, rtol=1e-9)


def test_what_follows_from_lengths_follows_from_these():
    scenario = loaded(*BOTH)
    spec = scenario.object
    free = spec.arc_lengths[-1] - 0.5 * (spec.segment_lengths[0] + spec.segment_lengths[-1])
    assert spec.free_length(0, 27) == pytest.approx(free)
    assert make_body(spec).free_length(0, 27) == pytest.approx(free)
    assert pair_limits(scenario, 0, 1).max_distance == pytest.approx(0.99 * free)
    assert spec.segment_at(spec.centre(5)) == 5
    edges, lengths = spec.edges()
    np.testing.assert_allclose(lengths, spec.segment_lengths)
    assert len(edges) == 28
    assert spec.description().endswith("28 segments of 0.021 to 0.11 m")
    assert loaded().object.description().endswith("28 segments")


def test_agents_without_a_start_hold_their_segments_where_they_are():
    agents = (
        "agents={leader: {particle: 0, role: leader, grip_length: 0.02}, "
        "follower: {particle: 27, role: assistant, grip_length: 0.05}}"
    )
    with pytest.raises(ScenarioError) as error:  # taut, which is beyond the limit
        loaded(agents)
    length = 2.25 - 0.5 * (0.02 + 0.05) - 0.26 * 2.25 / 28
    assert "{:.4g} m from leader".format(length) in str(error.value)


def test_a_middle_grip_stays_where_its_segment_was():
    grips = ["agents.{}.grip_length=0.02".format(name) for name in ("leader", "assistant_1")]
    plain, gripped = loaded(name="rope_two_assistants"), loaded(*grips, name="rope_two_assistants")
    middle = next(a.particle for a in plain.agents if a.name == "assistant_1")
    assert gripped.object.centre(middle) == pytest.approx(plain.object.centre(middle))


def test_a_resolved_scenario_means_the_same():
    scenario = loaded(*BOTH, "agents.leader.grip_length=0.0")
    mapping = scenario_to_mapping(scenario)
    again = scenario_from_mapping(mapping, ".")
    assert again.object == scenario.object and again.agents == scenario.agents


def test_it_is_simulated_as_the_rod_of_the_scenario():
    scenario = loaded(*BOTH)
    simulation = make_simulation(scenario, copies=False)
    lengths = np.linalg.norm(np.diff(simulation.points()[0], axis=0), axis=1)
    np.testing.assert_allclose(lengths, scenario.object.segment_lengths, rtol=1e-4)


@pytest.mark.parametrize(
    "overrides, key, reason",
    [
        (["leader.grip_length=-0.01"], "agents.leader.grip_length", ">= 0"),
        (["leader.grip_length=wide"], "agents.leader.grip_length", "or auto"),
        (["leader.grip_length=2.25"], "agents.leader.grip_length", "less than object.length"),
        (
            ["leader.grip_length=0.02", "leader.hold=pinned"],
            "agents.leader.grip_length",
            "pinned agent",
        ),
        (
            ["leader.grip_length=1.3", "assistant_1.grip_length=1.2"],
            "agents",
            "between the grips of leader and assistant_1",
        ),
        (
            ["leader.particle=1", "leader.grip_length=0.3"],
            "agents",
            "between the first end and the grip of leader",
        ),
        (
            ["leader.particle=26", "leader.grip_length=0.02"],
            "agents",
            "between the grips of leader and assistant_1",
        ),
    ],
)
def test_mistakes_are_named(overrides, key, reason):
    with pytest.raises(ScenarioError) as error:
        loaded(*("agents." + override for override in overrides))
    text = str(error.value)
    assert key + ":" in text and reason in text


def test_fabrics_have_no_grips_of_a_length():
    with pytest.raises(ScenarioError, match="agents.leader.grip_length: .*ropes and rods"):
        loaded("agents.leader.grip_length=0.02", name="fabric_three_assistants")


@pytest.mark.parametrize(
    "grips, key, reason",
    [
        ("[{particle: 0, length: 0.02}]", "object.grips", "follows from the agents"),
        ("[{particle: 28}]", "object.grips.0.particle", "0 to 27"),
        ("[{particle: 3}, {particle: 2}]", "object.grips.1.particle", "4 to 27"),
        ("[{particle: 0, length: 3.0}]", "object.grips.0.length", "less than object.length"),
        ("[{particle: 3, length: 0.3}, {particle: 4}]", "object.grips", "a segment between them"),
    ],
)
def test_grips_of_the_object_are_checked(grips, key, reason):
    with pytest.raises(ScenarioError) as error:
        loaded("object.grips=" + grips)
    text = str(error.value)
    assert key + ":" in text and reason in text


def test_mujoco_refuses_them():
    with pytest.raises(ScenarioError, match="object.grips: .*mujoco"):
        loaded(*BOTH, "knowledge.world=mujoco")
