import dataclasses

import numpy as np
import pytest

from deformable_manipulation.motion.leader import LeaderController, LeaderTurning
from deformable_manipulation.motion.steering import (
    DRAG_TIMEOUT,
    DRAGGED,
    PATH,
    RESTING,
    STEERED,
    WAITING,
    SteeredLeader,
)
from deformable_manipulation.scenario import leader_workspace, load_scenario

DT = 0.01


class Clock:
    now = 50.0

    def __call__(self):
        return self.now


class Run:
    """A leader whose commands act one cycle late, with a clock that goes along."""

    def __init__(self, scenario, **options):
        self.clock = Clock()
        self.leader = SteeredLeader(scenario, clock=self.clock, **options)
        self.cycle = 0
        self.position = np.array(scenario.agents[scenario.leader_index].start)
        self.velocity = np.zeros(3)

    def go(self, cycles, before_each=lambda: None):
        for _ in range(cycles):
            before_each()
            command = self.leader.update(DT * self.cycle, self.position)
            self.position = self.position + DT * self.velocity
            self.velocity = command
            self.cycle += 1
            self.clock.now += DT
        return self


@pytest.fixture(scope="module")
def scenario():
    return load_scenario("rope_one_assistant")


@pytest.fixture
def by_hand(scenario):
    return Run(scenario, follows_path=False)


def test_follows_its_path_until_a_hand_takes_it(scenario):
    run, path = Run(scenario), LeaderController(scenario)
    for cycle in range(3000):
        np.testing.assert_array_equal(
            run.leader.update(DT * cycle, run.position), path.update(DT * cycle, run.position)
        )
    assert run.leader.source == PATH
    run.leader.drag(run.position)
    assert run.leader.source == DRAGGED


def test_a_takeover_does_not_jump(scenario):
    run = Run(scenario).go(2000)
    before = run.velocity
    assert np.linalg.norm(before) > 0.01
    run.leader.steer((0.0, -1.0, 0.0))
    run.go(1)
    step = scenario.leader.max_acceleration * DT
    assert np.abs(run.velocity - before).max() <= step + 1e-12


def test_rests_until_a_hand_takes_it(by_hand):
    start = by_hand.position
    by_hand.go(2000)
    np.testing.assert_array_equal(by_hand.position, start)
    assert by_hand.leader.source == RESTING


def test_goes_where_it_is_dragged(by_hand):
    target = by_hand.position + (0.1, 0.05, -0.02)
    by_hand.go(400, lambda: by_hand.leader.drag(target))
    np.testing.assert_allclose(by_hand.position, target, atol=1e-9)


def test_stops_when_it_is_released_or_no_longer_held(by_hand):
    far = by_hand.position + (0.0, 5.0, 0.0)
    for stop in (by_hand.leader.release, lambda: by_hand.go(int(DRAG_TIMEOUT / DT) + 1)):
        by_hand.go(100, lambda: by_hand.leader.drag(far))
        assert by_hand.velocity[1] > 0.05
        stop()
        assert by_hand.leader.source == RESTING
        by_hand.go(60)
        np.testing.assert_array_equal(by_hand.velocity, 0.0)


def test_steering_has_a_dead_man_s_timeout(by_hand, scenario):
    by_hand.go(100, lambda: by_hand.leader.steer((0.0, 0.05, 0.0)))
    np.testing.assert_allclose(by_hand.velocity, (0.0, 0.05, 0.0), atol=1e-12)
    assert by_hand.leader.source == STEERED
    by_hand.go(int(scenario.controller.timeout / DT) + 2)
    assert by_hand.leader.source == RESTING
    by_hand.go(60)
    np.testing.assert_array_equal(by_hand.velocity, 0.0)


def test_stays_in_the_workspace(by_hand, scenario):
    lower, upper = leader_workspace(scenario)
    by_hand.go(3000, lambda: by_hand.leader.steer((1.0, 1.0, -1.0)))
    np.testing.assert_allclose(by_hand.position, (upper[0], upper[1], lower[2]), atol=1e-9)


@pytest.mark.parametrize("take", ["drag", "steer"])
@pytest.mark.parametrize("values", [(0.0, np.nan, 0.0), (np.inf, 0.0, 0.0), (1.0, 2.0)])
def test_what_is_not_three_finite_numbers_is_refused_and_changes_nothing(by_hand, take, values):
    with pytest.raises(ValueError, match="must be three finite numbers"):
        getattr(by_hand.leader, take)(values)
    assert by_hand.leader.source == RESTING


def test_waits_until_all_follow_and_begins_its_path_then(scenario):
    run, path = Run(scenario), LeaderController(scenario)
    for cycle in range(500):
        np.testing.assert_array_equal(run.leader.update(DT * cycle, run.position, False), 0.0)
    assert run.leader.source == WAITING
    for cycle in range(1000):
        expected = path.update(DT * cycle, run.position)
        all_follow = cycle == 0  # who stops later does not stop the leader
        velocity = run.leader.update(DT * (500 + cycle), run.position, all_follow)
        np.testing.assert_allclose(velocity, expected, 0.0, 1e-10)
    assert run.leader.source == PATH


def test_begins_its_path_when_it_is_told_to(scenario):
    run = Run(scenario)
    run.leader.update(0.0, run.position, False)
    run.leader.start()
    run.leader.update(DT, run.position, False)
    assert run.leader.source == PATH
    with pytest.raises(ValueError, match="on its path already"):
        run.leader.start()
    run.leader.drag(run.position)
    with pytest.raises(ValueError, match="by hand"):
        run.leader.start()
    run.leader.reset()
    run.leader.update(0.0, run.position, False)
    assert run.leader.source == WAITING


def test_a_new_node_goes_on_from_where_it_finds_the_leader(scenario):
    run = Run(scenario).go(2000)
    assert np.linalg.norm(run.velocity) > 0.01
    anew = SteeredLeader(scenario)
    for time in (3000 * DT, 3001 * DT):
        velocity = anew.update(time, run.position)
    assert np.linalg.norm(velocity - run.velocity) < 0.5 * np.linalg.norm(run.velocity)


def test_waits_again_where_time_is_set_back(scenario):
    run = Run(scenario).go(500)
    run.leader.update(0.0, run.position, False)
    assert run.leader.source == WAITING


@pytest.mark.parametrize("follows_path, expected", [(True, PATH), (False, RESTING)])
def test_a_reset_takes_it_out_of_the_hand(scenario, follows_path, expected):
    run = Run(scenario, follows_path=follows_path)
    run.go(50, lambda: run.leader.steer((0.0, 1.0, 0.0)))
    run.leader.reset()
    start = scenario.agents[scenario.leader_index].start
    np.testing.assert_array_equal(run.leader.update(0.0, start), 0.0)
    assert run.leader.source == expected


def test_a_state_is_answered_once_and_one_that_is_not_finite_with_zero(by_hand):
    by_hand.go(20, lambda: by_hand.leader.steer((0.0, 1.0, 0.0)))
    update, place = by_hand.leader.update, by_hand.position
    np.testing.assert_array_equal(update(DT * 19, place + 1.0), by_hand.velocity)
    np.testing.assert_array_equal(update(np.nan, place), 0.0)
    np.testing.assert_array_equal(update(1.0, (np.nan, 0.0, 0.0)), 0.0)


def test_the_box_is_around_the_path_unless_it_is_given(scenario):
    start = np.array(scenario.agents[scenario.leader_index].start)
    plain = dataclasses.replace(scenario.leader, workspace=None)
    lower, upper = leader_workspace(dataclasses.replace(scenario, leader=plain))
    for waypoint in scenario.leader.waypoints:
        assert (start + waypoint.position >= np.array(lower) + 0.499).all()
        assert (start + waypoint.position <= np.array(upper) - 0.499).all()


def test_the_grip_turns_on_the_path_and_not_by_hand():
    """From the time on at which the path begins."""
    scenario = load_scenario("fabric_clamp_bars")
    run = Run(scenario)
    orientation = (0.0, 0.0, 0.0, 1.0)
    assert not run.leader.turn(0.0, orientation).any()  # the path has not begun
    run.go(1500)  # 15 s, in the middle of the turn
    now = DT * (run.cycle - 1)
    own = LeaderTurning(scenario).update(now, orientation)
    assert own[2] > 0.0
    np.testing.assert_allclose(run.leader.turn(now, orientation), own)
    run.leader.steer((0.0, 0.05, 0.0))
    run.go(1)
    assert not run.leader.turn(now + DT, orientation).any()
