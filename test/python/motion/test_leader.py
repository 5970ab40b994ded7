import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from deformable_manipulation.motion.leader import LeaderController, LeaderPath, LeaderTurning
from deformable_manipulation.objects.rod import RodSpec
from deformable_manipulation.scenario.spec import (
    AgentSpec,
    CollisionSpec,
    ControllerSpec,
    LeaderSpec,
    Scenario,
    SimulationSpec,
    Waypoint,
)

WAYPOINTS = (
    Waypoint(0.0, (0.0, 0.0, 0.0)),
    Waypoint(2.0, (0.1, 0.4, -0.2)),
    Waypoint(3.0, (0.3, 0.5, -0.2)),
    Waypoint(7.0, (0.2, 0.9, 0.1)),
)
DT = 0.01


@pytest.fixture
def path():
    return LeaderPath(WAYPOINTS)


@pytest.fixture
def scenario():
    return Scenario(
        name="test",
        object=RodSpec(2.25, 0.0035, 1792.89, 28, 3e7, 1e7),
        agents=(
            AgentSpec("leader", 0, "leader", start=(1.0, 2.0, 3.0)),
            AgentSpec("assistant_1", 27, "assistant"),
        ),
        obstacles=(),
        leader=LeaderSpec(WAYPOINTS),
        controller=ControllerSpec(collision=CollisionSpec(offset=0.05)),
        simulation=SimulationSpec(duration=1.0),
    )


def test_passes_through_the_waypoints(path):
    for waypoint in WAYPOINTS:
        np.testing.assert_allclose(path.position(waypoint.time), waypoint.position, atol=1e-14)


def test_rests_before_and_after(path):
    times = np.array([-5.0, 0.0, 7.0, 100.0])
    np.testing.assert_allclose(path.velocity(times), 0.0, atol=1e-14)
    np.testing.assert_allclose(path.position(times[:2]), 0.0)
    np.testing.assert_allclose(path.position(times[2:]), [WAYPOINTS[-1].position] * 2)


def test_velocity_is_the_derivative_of_the_position(path):
    times = np.linspace(-1.0, 8.0, 400)
    step = 1e-6
    rate = (path.position(times + step) - path.position(times - step)) / (2.0 * step)
    np.testing.assert_allclose(path.velocity(times), rate, atol=1e-8)


def test_is_twice_continuously_differentiable_with_no_acceleration_at_waypoints(path):
    step = 1e-6
    for waypoint in WAYPOINTS:
        before, at, after = path.velocity(waypoint.time + step * np.array([-1.0, 0.0, 1.0]))
        np.testing.assert_allclose((after - at) / step, 0.0, atol=1e-4)
        np.testing.assert_allclose((at - before) / step, 0.0, atol=1e-4)


def test_shapes(path):
    assert path.position(1.0).shape == (3,)
    assert path.velocity(np.zeros((2, 5))).shape == (2, 5, 3)
    single = LeaderPath(WAYPOINTS[1:2])
    np.testing.assert_array_equal(single.position([0.0, 9.0]), [WAYPOINTS[1].position] * 2)
    np.testing.assert_array_equal(single.velocity(1.0), np.zeros(3))


def test_a_single_time_gives_the_same(path):
    times = np.linspace(-1.0, 8.0, 50).tolist() + [waypoint.time for waypoint in WAYPOINTS]
    np.testing.assert_allclose([path.at(t) for t in times], path.position(times), atol=1e-15)
    assert LeaderPath(WAYPOINTS[1:2]).at(9.0) == list(WAYPOINTS[1].position)


values = st.floats(-2.0, 2.0)


@settings(max_examples=60, deadline=None)
@given(st.lists(st.tuples(st.floats(0.05, 10.0), values, values, values), min_size=2, max_size=7))
def test_never_leaves_the_range_of_the_waypoints_nor_twice_the_mean_speed(pieces):
    times = np.cumsum([piece[0] for piece in pieces])
    waypoints = [Waypoint(t, piece[1:]) for t, piece in zip(times, pieces)]
    path = LeaderPath(waypoints)
    for first, last in zip(waypoints, waypoints[1:]):
        inside = np.linspace(first.time, last.time, 60)
        ends = np.sort([first.position, last.position], axis=0)
        position = path.position(inside)
        assert (position >= ends[0] - 1e-12).all() and (position <= ends[1] + 1e-12).all()
        mean = (ends[1] - ends[0]) / (last.time - first.time)
        assert (np.abs(path.velocity(inside)) <= 2.0 * mean + 1e-9).all()


@pytest.mark.parametrize(
    "waypoints, message",
    [
        ((), "empty"),
        ((Waypoint(1.0, (0, 0, 0)), Waypoint(1.0, (1, 0, 0))), r"waypoints\[1\].time: 1"),
        ((Waypoint(0.0, (0, 0, np.nan)),), "finite"),
        ((Waypoint(0.0, (0, 0)),), r"waypoints\[0\].position: \(0, 0\) must be three"),
        ((Waypoint(0.0, (0, 0, 0)), Waypoint(1.0, 2.0)), r"waypoints\[1\].position: 2.0"),
        ((Waypoint(0.0, ((0, 0, 0),)),), r"waypoints\[0\].position"),
    ],
)
def test_refuses_waypoints_that_make_no_path(waypoints, message):
    with pytest.raises(ValueError, match=message):
        LeaderPath(waypoints)


def followed(scenario, cycles, start, disturb=None):
    """Positions of a leader whose commands act one cycle late."""
    controller, position, acting = LeaderController(scenario), np.array(start), np.zeros(3)
    positions, commands = [], []
    for k in range(cycles):
        positions.append(position)
        commands.append(controller.update(k * DT, position))
        position = position + DT * acting
        acting = commands[-1]
        if disturb is not None and k == disturb[0]:
            position = position + disturb[1]
    return np.array(positions), np.array(commands)


def test_stays_on_the_path_despite_the_delay(scenario):
    positions, _ = followed(scenario, 800, (1.0, 2.0, 3.0))
    exact = (1.0, 2.0, 3.0) + LeaderPath(WAYPOINTS).position(DT * np.arange(800))
    # The path's first cycle is missed: the first command acts from state 1 on.
    np.testing.assert_allclose(positions[2:], exact[2:], atol=1e-12)


def test_returns_after_a_disturbance_at_a_limited_speed(scenario):
    push = np.array([0.0, 0.05, -0.02])
    positions, commands = followed(scenario, 800, (1.0, 2.0, 3.0), (200, push))
    exact = (1.0, 2.0, 3.0) + LeaderPath(WAYPOINTS).position(DT * np.arange(800))
    np.testing.assert_allclose(positions[300:], exact[300:], atol=1e-12)
    fastest = np.abs(LeaderPath(WAYPOINTS).velocity(DT * np.arange(800))).max()
    assert np.abs(commands).max() <= fastest + scenario.controller.max_velocity + 1e-9


def test_a_state_is_answered_once_and_reset_forgets(scenario):
    controller = LeaderController(scenario)
    start = np.array([1.0, 2.0, 3.0])
    controller.update(1.0, start)
    second = controller.update(1.01, start)
    np.testing.assert_array_equal(controller.update(1.01, start + 1.0), second)
    controller.reset()
    again = controller.update(0.0, start)
    np.testing.assert_array_equal(again, LeaderController(scenario).update(0.0, start))


@pytest.mark.parametrize(
    "time, value", [(np.nan, 0.0), (0.0, np.nan), (np.inf, 0.0), (0.0, np.inf)]
)
def test_what_is_not_finite_gives_zero(scenario, time, value):
    command = LeaderController(scenario).update(time, np.full(3, value))
    np.testing.assert_array_equal(command, 0.0)


def test_the_path_alone_sets_the_speed(scenario):
    fast = tuple(dataclasses.replace(w, time=w.time / 10.0) for w in WAYPOINTS)
    scenario = dataclasses.replace(scenario, leader=LeaderSpec(fast))
    positions, commands = followed(scenario, 100, (1.0, 2.0, 3.0))
    np.testing.assert_allclose(positions[-1], (1.2, 2.9, 3.1), atol=1e-12)
    assert np.abs(commands).max() > scenario.controller.max_velocity


START = tuple(Rotation.from_rotvec([0.3, 0.0, 0.0]).as_quat())
TURNS = (
    Waypoint(0.0, (0.0, 0.0, 0.0)),
    Waypoint(2.0, (0.0, 0.0, 0.0), tuple(Rotation.from_rotvec([0.0, 0.0, 1.2]).as_quat())),
    Waypoint(5.0, (0.0, 0.0, 0.0), tuple(Rotation.from_rotvec([0.0, 0.8, 1.2]).as_quat())),
)


@pytest.fixture
def turning(scenario):
    agents = list(scenario.agents)
    leader = scenario.leader_index
    agents[leader] = dataclasses.replace(agents[leader], orientation=START)
    path = dataclasses.replace(scenario.leader, waypoints=TURNS)
    return dataclasses.replace(scenario, agents=tuple(agents), leader=path)


def turned_for(controller, cycles, orientation):
    """The orientation after so many cycles; a command acts one cycle late."""
    velocity, orientations = np.zeros(3), []
    for cycle in range(cycles):
        command = controller.update(DT * cycle, orientation.as_quat())
        orientation = Rotation.from_rotvec(DT * velocity) * orientation
        velocity = command
        orientations.append(orientation)
    return orientations


def test_the_grip_is_turned_as_the_waypoints_say(turning):
    start = Rotation.from_quat(START)
    passed = turned_for(LeaderTurning(turning), 600, start)
    for waypoint in TURNS[1:]:
        wanted = Rotation.from_quat(waypoint.orientation) * start
        cycle = round(waypoint.time / DT) - 1  # at whose end
        assert (wanted * passed[cycle].inv()).magnitude() < 1e-6
    assert (passed[-1] * passed[-2].inv()).magnitude() < 1e-9
    rates = [(b * a.inv()).magnitude() / DT for a, b in zip(passed, passed[1:])]
    assert max(np.abs(np.diff(rates))) < 0.03  # rad/s: no leaps


def test_a_grip_that_was_turned_away_comes_back_within_the_limit(turning):
    limit = turning.controller.max_angular_velocity
    away = Rotation.from_rotvec([0.0, 0.5, 0.0]) * Rotation.from_quat(START)
    still = dataclasses.replace(
        turning,
        leader=dataclasses.replace(
            turning.leader,
            waypoints=tuple(dataclasses.replace(each, time=100.0 * each.time) for each in TURNS),
        ),
    )
    passed = turned_for(LeaderTurning(still), 400, away)
    rates = [(b * a.inv()).magnitude() / DT for a, b in zip(passed, passed[1:])]
    assert max(rates) < limit + 0.02
    assert max(rates) > 0.9 * limit
    assert (passed[-1] * Rotation.from_quat(START).inv()).magnitude() < 0.01


def test_a_path_without_turns_turns_nothing(scenario):
    turning = LeaderTurning(scenario)
    assert not turning.turns
    assert not turning.update(0.0, (0.0, 0.6, 0.0, 0.8)).any()


def test_orientations_that_are_not_finite_stop_the_turn(turning):
    controller = LeaderTurning(turning)
    assert controller.update(1.0, START).any()
    assert not controller.update(1.01, (np.nan, 0.0, 0.0, 1.0)).any()
