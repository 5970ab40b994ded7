"""An assistant that an obstacle holds off its place finds a way around."""

import functools

import numpy as np
import pytest

from deformable_manipulation.control.status import DetourState
from deformable_manipulation.running.closed_loop import ClosedLoop
from deformable_manipulation.scenario import load_scenario, scenario_from_mapping
from deformable_manipulation.scenario.mapping import scenario_to_mapping

SHELF = [[1.0, 1.1], [2.3, 1.1], [2.3, 1.2], [1.0, 1.2]]  # m, y and z
OFFSET = 0.05


def shelf_scenario(rise, duration, horizon=3.0, goes_on=None, **controller):
    """The leader rises beside a shelf, the assistant starts below it and is to come above it.

    ``goes_on``: time [s] at which the leader moves again.
    """
    mapping = scenario_to_mapping(load_scenario("rope_one_assistant"))
    leader, assistant = mapping["agents"].values()
    mapping["object"]["pose"]["position"] = leader["start"] = [0.0, 0.0, 0.9]
    assistant["start"] = [0.0, 1.6, 0.7]
    mapping["obstacles"] = [{"name": "shelf", "polygon": SHELF, "plane": "yz"}]
    mapping["leader"]["waypoints"] = [
        {"time": 0.0, "position": [0.0, 0.0, 0.0]},
        {"time": 18.0 * rise / 1.4, "position": [0.0, 0.0, rise]},
    ]
    if goes_on is not None:
        mapping["leader"]["waypoints"] += [
            {"time": goes_on, "position": [0.0, 0.0, rise]},
            {"time": goes_on + 2.0, "position": [0.0, 0.1, rise]},
        ]
    mapping["simulation"]["duration"] = duration
    mapping["controller"]["horizon"]["length"] = horizon
    mapping["controller"].update(controller)
    return scenario_from_mapping(mapping, ".")


@functools.lru_cache(maxsize=None)
def run(rise=1.4, duration=45.0, **controller):
    scenario = shelf_scenario(rise, duration, **controller)
    loop = ClosedLoop(scenario)
    return [loop.step() for _ in range(scenario.cycles)]


def decisions(records):
    return [record.decisions["assistant_1"] for record in records]


def test_it_comes_home_around_the_shelf_and_keeps_all_limits():
    records = run()
    states = [decision.detour for decision in decisions(records)]
    in_order = [state for state, before in zip(states, [None, *states]) if state != before]
    assert in_order == [
        DetourState.NONE,
        DetourState.SEARCHING,
        DetourState.FOLLOWING,
        DetourState.NONE,
    ]
    assert decisions(records)[-1].error_norm < 0.01
    assert min(record.distance for record in records) > OFFSET
    for barrier in ("overstretch", "proximity"):
        assert min(decision.h[barrier] for decision in decisions(records)) > 0.0
    # Around its end: it was below the shelf, then beside it.
    path = np.array([decision.position for decision in decisions(records)])
    assert path[:, 1].min() < SHELF[0][0]


def test_without_detours_it_stays_below():
    last = decisions(run(detours=False))[-1]
    assert last.detour == DetourState.NONE
    assert last.error_norm > 0.5


def test_the_text_tells_what_it_does():
    texts = {decision.detour: decision.text for decision in decisions(run())}
    assert "looks for a way around" in texts[DetourState.SEARCHING]
    assert "takes a way around" in texts[DetourState.FOLLOWING]


def test_the_same_run_finds_the_same_way():
    scenario = shelf_scenario(1.4, 26.0)
    loop = ClosedLoop(scenario)
    again = [loop.step() for _ in range(scenario.cycles)]
    np.testing.assert_array_equal(
        [decision.command for decision in decisions(again)],
        [decision.command for decision in decisions(run())[: len(again)]],
    )


def test_it_says_so_if_there_is_no_way():
    """Above the shelf the rope would hang into it."""
    last = decisions(run(rise=1.0, duration=48.0, horizon=0.0))[-1]
    assert last.detour == DetourState.NO_WAY
    assert "no way around within the limits was found" in last.text


def test_a_leader_that_goes_on_ends_the_search():
    states = [decision.detour for decision in decisions(run(duration=24.0, goes_on=22.0))]
    assert DetourState.SEARCHING in states
    assert states[-1] == DetourState.NONE


@pytest.mark.parametrize("name", ["fabric_three_assistants", "rope_moving_obstacle"])
def test_scenarios_without_known_shapes_or_obstacles_run_as_before(name):
    scenario = load_scenario(name, [("simulation.duration", "0.2")])
    loop = ClosedLoop(scenario)
    for _ in range(scenario.cycles):
        record = loop.step()
    assert {decision.detour for decision in record.decisions.values()} == {DetourState.NONE}
