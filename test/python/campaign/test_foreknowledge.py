"""What anybody could have done: bounds and controllers that know the path."""

import dataclasses

import numpy as np
import pytest

from deformable_manipulation.campaign import runs
from deformable_manipulation.campaign.foreknowledge import least_overstretch, with_foresight
from deformable_manipulation.campaign.outcome import IMPOSSIBLE, KEPT, POSSIBLE, UNKNOWN
from deformable_manipulation.campaign.runs import Campaign, Classes
from deformable_manipulation.campaign.variation import Ranges
from deformable_manipulation.scenario import load_scenario, pair_limits
from deformable_manipulation.scenario.spec import Waypoint

FAST = 0.3  # m/s, twice the assistants' velocity


def pulled_away(name="rope_one_assistant", seconds=8.0, speed=FAST, wait=2.0, overrides=()):
    """A leader that goes straight away from its assistants and stays there."""
    scenario = load_scenario(name, overrides)
    way = (0.0, -speed * seconds, 0.0)
    waypoints = (
        Waypoint(0.0, (0.0, 0.0, 0.0)),
        Waypoint(wait, (0.0, 0.0, 0.0)),
        Waypoint(wait + seconds, way),
    )
    return dataclasses.replace(
        scenario,
        leader=dataclasses.replace(scenario.leader, waypoints=waypoints),
        simulation=dataclasses.replace(scenario.simulation, duration=30.0),
    )


def along_a_line(scenario):
    """The same bound in one dimension, step by step: who follows at once loses least."""
    from deformable_manipulation.motion.leader import LeaderPath

    leader, assistant = scenario.agents
    times = np.arange(0.0, scenario.simulation.duration, 0.01)
    led = LeaderPath(scenario.leader.waypoints).position(times)[:, 1]
    length = pair_limits(scenario, 0, 1).max_distance
    reached = assistant.start[1] - scenario.controller.max_velocity * times
    return max(0.0, (reached - (leader.start[1] + led) - length).max())


@pytest.mark.parametrize("seconds", [4.0, 6.0, 8.0])
def test_a_straight_pull_needs_what_it_needs(seconds):
    scenario = pulled_away(seconds=seconds)
    expected = along_a_line(scenario)
    assert least_overstretch(scenario) == pytest.approx(expected, abs=2e-3)


def test_a_slow_leader_overstretches_nothing():
    assert least_overstretch(pulled_away(speed=0.1)) == 0.0


def test_between_two_assistants_it_is_shared():
    """The far one is at its limit first; the near one waits for it."""
    pulled = pulled_away("rope_two_assistants")
    one = least_overstretch(pulled)
    assert one > 0.05
    slower = dataclasses.replace(
        pulled, controller=dataclasses.replace(pulled.controller, max_velocity=0.1)
    )
    assert least_overstretch(slower) > one + 0.05


def test_the_bound_is_below_what_a_run_needs():
    campaign = Campaign(load_scenario("rope_one_assistant"), Ranges(), 0)
    scenario = pulled_away()
    outcome = campaign._judged(scenario, campaign._run(scenario, 0))
    assert outcome.answer == IMPOSSIBLE
    assert 0.0 < outcome.least_overstretch <= outcome.violations["overstretch"]


def test_foresight_knows_the_path():
    for each in with_foresight(load_scenario("rope_one_assistant")):
        horizon = each.controller.horizon
        assert horizon.leader == "known" and horizon.length > 3.0


@pytest.mark.parametrize(
    "asked, missed, answer",
    [(False, True, UNKNOWN), (True, False, POSSIBLE), (True, True, UNKNOWN)],
)
def test_runs_that_miss_a_limit_are_tried_again_if_asked(monkeypatch, asked, missed, answer):
    scenario = load_scenario("rope_one_assistant")
    campaign = Campaign(scenario, Ranges(), 0, foreknowledge=asked)
    kept = runs._not_started(3, "")
    kept = dataclasses.replace(kept, completed=True, problem="")
    missing = dataclasses.replace(kept, violations={"collision": 0.01})
    monkeypatch.setattr(runs, "least_overstretch", lambda _scenario: 0.0)
    monkeypatch.setattr(Campaign, "_run", lambda *_: missing if missed else kept)
    assert campaign._judged(scenario, missing).answer == answer
    assert campaign._judged(scenario, kept).answer == KEPT


def test_classes_number_their_runs_through():
    scenario = load_scenario("rope_one_assistant")
    first, second = (Campaign(scenario, Ranges(speed=speed), 1) for speed in (0.1, 0.2))
    classes = Classes((first, second), runs=5)
    assert len(classes) == 10
    assert classes.locate(4) == (first, 4) and classes.locate(5) == (second, 0)
