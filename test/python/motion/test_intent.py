"""What a leader announces."""

import dataclasses

import numpy as np
import pytest

from deformable_manipulation.motion.intent import Intent, leader_announces, times_ahead
from deformable_manipulation.motion.leader import LeaderController
from deformable_manipulation.motion.steering import SteeredLeader
from deformable_manipulation.scenario import load_scenario

ANNOUNCED = ("controller.horizon.leader", "announced")


@pytest.fixture(scope="module")
def scenario():
    return load_scenario("rope_one_assistant", [ANNOUNCED])


def test_a_scripted_leader_is_where_it_has_announced_to_be(scenario):
    leader = LeaderController(scenario)
    position = np.array(scenario.agents[scenario.leader_index].start)
    dt = scenario.cycle_time
    announced, velocity = None, np.zeros(3)
    for cycle in range(1900):
        command = leader.update(cycle * dt, position)
        if cycle == 1600:
            announced = leader.intent(cycle * dt)
        if announced is not None:
            axes = (np.interp(cycle * dt, announced.times, axis) for axis in announced.positions.T)
            np.testing.assert_allclose(position, list(axes), atol=2e-3)
        position, velocity = position + dt * velocity, command
    assert np.ptp(announced.positions, axis=0).max() > 0.05


def test_it_covers_the_horizon_and_what_it_may_be_old(scenario):
    ahead = times_ahead(scenario)
    controller = scenario.controller
    assert ahead[0] == 0.0
    assert ahead[-1] == pytest.approx(controller.horizon.length + controller.timeout)


@pytest.mark.parametrize(
    "times, positions, fault",
    [
        ([0.0, 1.0], np.zeros((3, 3)), "shapes"),
        ([0.0, 1.0], np.zeros((2, 2)), "shapes"),
        ([0.0], np.zeros((1, 3)), "at least two"),
        ([0.0, np.nan], np.zeros((2, 3)), "not finite"),
        ([1.0, 1.0], np.zeros((2, 3)), "not after"),
        ([0.0, 0.1], [[0.0, 0.0, 0.0], [0.0, 0.0, 2.0]], "faster than 5 m/s"),
    ],
)
def test_what_cannot_be_used_is_refused(times, positions, fault):
    with pytest.raises(ValueError, match=fault):
        Intent(np.array(times), np.array(positions))


def test_a_leader_on_its_path_announces_it(scenario):
    leader = SteeredLeader(scenario)
    start = scenario.agents[scenario.leader_index].start
    leader.update(10.0, start)  # the path begins here, whatever the time
    intent = leader.intent()
    expected = LeaderController(scenario).intent(0.0)
    np.testing.assert_allclose(intent.times, 10.0 + expected.times)
    np.testing.assert_array_equal(intent.positions, expected.positions)


def test_a_leader_that_waits_or_is_moved_by_hand_announces_nothing(scenario):
    leader = SteeredLeader(scenario)
    start = scenario.agents[scenario.leader_index].start
    leader.update(0.0, start, all_follow=False)
    assert leader.intent() is None
    leader.update(0.01, start)
    assert leader.intent() is not None
    leader.steer([0.0, 0.1, 0.0])
    leader.update(0.02, start)
    assert leader.intent() is None


def test_whoever_moves_a_real_leader_announces_its_path(scenario):
    assert leader_announces(scenario)
    agents = list(scenario.agents)
    leader = scenario.leader_index
    agents[leader] = dataclasses.replace(agents[leader], driven_by="pose")
    assert not leader_announces(dataclasses.replace(scenario, agents=tuple(agents)))
    assert not leader_announces(load_scenario("rope_one_assistant"))
