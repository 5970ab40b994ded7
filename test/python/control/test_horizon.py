"""Looking ahead: what cannot be answered later is answered now."""

import dataclasses

import control_builders as build
import numpy as np
import pytest

from deformable_manipulation.campaign.runs import Campaign
from deformable_manipulation.campaign.variation import Ranges
from deformable_manipulation.control.team import TeamController
from deformable_manipulation.running.closed_loop import ClosedLoop
from deformable_manipulation.scenario import load_scenario
from deformable_manipulation.scenario.spec import HorizonSpec

PRESENT_ONLY = ("controller.horizon.length", "0")
DIVE = [
    {"time": 0.0, "position": [0.0, 0.0, 0.0]},
    {"time": 1.0, "position": [0.0, 0.0, 0.0]},
    {"time": 5.0, "position": [0.0, 0.0, -0.6]},
]


def records(name, seconds, *overrides, **changes):
    scenario = load_scenario(name, overrides)
    if changes:
        scenario = dataclasses.replace(scenario, **changes)
    loop = ClosedLoop(scenario)
    return [loop.step() for _ in range(round(seconds * scenario.controller.rate))]


def commands(run, name="assistant_1"):
    return np.array([record.decisions[name].command for record in run])


def outcome(index, *overrides):
    scenario = load_scenario("rope_one_assistant", overrides)
    return Campaign(scenario, Ranges(speed=0.3, duration=50.0), seed=7).run(index)


def test_far_from_all_limits_nothing_changes():
    ahead = records("rope_one_assistant", 20.0)
    present = records("rope_one_assistant", 20.0, PRESENT_ONLY)
    np.testing.assert_array_equal(commands(ahead), commands(present))


def test_a_leader_twice_as_fast_as_the_assistants_is_answered_in_time():
    """A random path on which the present cycle alone comes too late."""
    late = outcome(12, PRESENT_ONLY).violations
    assert late["collision"] > 0.03 and late["overstretch"] > 0.05
    assert max(outcome(12).violations.values()) < 0.001


def test_commands_do_not_alternate_from_cycle_to_cycle():
    """The rod's points take turns in being the nearest at the nodes."""
    run = records("stiff_rod_one_assistant", 95.0)
    steps = np.diff(commands(run), axis=0)
    assert np.abs(steps).max() < 0.004  # m/s
    turns = (steps[1:] * steps[:-1] < 0.0) & (np.minimum(abs(steps[1:]), abs(steps[:-1])) > 1e-3)
    assert not turns.any()


def test_the_assistant_gives_way_earlier():
    """Down over the hills, twice as fast as the assistant can follow."""
    dive = ("leader.waypoints", str(DIVE))
    first = {}
    for name, overrides in (("ahead", ()), ("present", (PRESENT_ONLY,))):
        run = records("rope_one_assistant", 6.0, dive, *overrides)
        nominal = np.array([record.decisions["assistant_1"].nominal for record in run])
        departs = np.abs(commands(run) - np.clip(nominal, -0.15, 0.15)).max(axis=1) > 0.02
        # The first cycles are those in which the acceleration is limited.
        first[name] = np.flatnonzero(departs & (nominal[:, 2] < -0.16)).min(initial=10**6)
    assert first["ahead"] < first["present"] - 5


@pytest.mark.parametrize("name", ["rope_two_assistants", "rope_moving_obstacle"])
def test_after_a_reset_the_same_states_get_the_same_answers(name):
    scenario = load_scenario(name)
    names = [scenario.agents[i].name for i in scenario.assistants]
    loop = ClosedLoop(dataclasses.replace(scenario))
    observations = []
    for _ in range(300):
        observations.append(_kept(loop._observer.observe()))
        loop.step()
    team = TeamController(scenario, names)
    runs = []
    for _ in range(2):
        runs.append([team.update(each)[names[0]].command for each in observations])
        team.reset()
    np.testing.assert_array_equal(runs[0], runs[1])


def _kept(observation):
    return dataclasses.replace(observation, points=observation.points.copy())


def test_another_object_than_the_scenario_s_is_not_predicted():
    """Its points do not fit the scenario's object: the present cycle decides alone."""
    positions = np.array([agent.start for agent in build.scenario().agents])
    positions[:, 2] -= 0.67  # so low that the chain is within the offset
    observation = build.observe(
        0.0, positions, build.hanging_chain(2, 0.3), build.HalfSpace((0.0, 0.0, 1.0), 0.0)
    )
    present = build.Alone(build.scenario()).update(observation)
    ahead = build.Alone(build.scenario(horizon=HorizonSpec())).update(observation)
    np.testing.assert_array_equal(ahead.command, present.command)
    assert np.abs(present.command).max() > 0.0


def test_one_that_is_switched_off_is_expected_to_stand():
    scenario = load_scenario("rope_two_assistants", [("controller.cooperation", "centralised")])
    loop = ClosedLoop(scenario)
    team = loop._controllers[0]
    team.set_enabled("assistant_2", False)
    for _ in range(100):
        decisions = loop.step().decisions
    np.testing.assert_array_equal(decisions["assistant_2"].command, 0.0)
    assert np.isfinite(decisions["assistant_1"].command).all()


def test_live_keys_of_the_horizon_act():
    scenario = load_scenario("rope_one_assistant", [("leader.waypoints", str(DIVE))])
    doubtful = dataclasses.replace(
        scenario,
        controller=dataclasses.replace(
            scenario.controller,
            horizon=dataclasses.replace(scenario.controller.horizon, leader_doubt=5.0),
        ),
    )
    moved = {}
    for name, parameters in (("as it was", scenario), ("doubtful", doubtful)):
        loop = ClosedLoop(scenario)
        loop._controllers[0].set_parameters(parameters)
        for _ in range(220):
            record = loop.step()
        moved[name] = record.positions[1, 2]
    assert moved["doubtful"] > moved["as it was"] + 0.01
