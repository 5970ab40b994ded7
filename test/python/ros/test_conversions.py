"""Messages, as a node receives them, and the core's arrays."""

import math
from pathlib import Path

import numpy as np
import pytest
from geometry_msgs.msg import TwistStamped
from mesh_reference import changed, fields_of
from messages import distances_message, state_message, transmitted
from nav_msgs.msg import Path as NavigationPath

from deformable_manipulation.control.observation import find_fault
from deformable_manipulation.distance.factory import make_minimum_distance
from deformable_manipulation.distance.features import Distances
from deformable_manipulation.motion.intent import Intent
from deformable_manipulation.msg import ControllerState
from deformable_manipulation.ros import conversions
from deformable_manipulation.ros.conversions import MessageError
from deformable_manipulation.running.closed_loop import ClosedLoop
from deformable_manipulation.scenario import load_scenario
from deformable_manipulation.simulation.factory import make_simulation

TWO_ASSISTANTS = Path(__file__).resolve().parents[2] / "rostest" / "two_assistants.yaml"
FILE_ORDER = ["leader", "middle_assistant", "end_assistant"]
MESSAGE_ORDER = ["end_assistant", "leader", "middle_assistant"]  # alphabetic, as the simulator's
ROWS = [FILE_ORDER.index(name) for name in MESSAGE_ORDER]


@pytest.fixture(scope="module")
def scenario():
    scenario = load_scenario(TWO_ASSISTANTS)
    assert [agent.name for agent in scenario.agents] == FILE_ORDER
    return scenario


@pytest.fixture(scope="module")
def simulation(scenario):
    """One whose last copy is not ready yet."""
    simulation = make_simulation(scenario)
    simulation.add_perturbation(0, (0.02, 0.0, 0.0))
    return simulation


@pytest.fixture(scope="module")
def computed(scenario, simulation):
    return make_minimum_distance(scenario).compute(simulation.points())


@pytest.fixture
def state(simulation):
    """The simulation's state with its agents in the message's order, not yet sent."""
    displaced = [
        MESSAGE_ORDER.index(FILE_ORDER[i]) if i >= 0 else -1 for i in simulation.displaced_agents()
    ]
    points = simulation.points()
    return state_message(
        stamp=12.5,
        cycle=150,
        reset_count=2,
        point_count=points.shape[1],
        agents=MESSAGE_ORDER,
        agent_positions=simulation.positions()[ROWS].ravel(),
        displaced_agents=displaced,
        displacements=simulation.displacements().ravel(),
        copy_ready=simulation.ready().tolist(),
        points=points.ravel(),
    )


@pytest.fixture
def distances(state, computed):
    return conversions.fill_distances(distances_message(), state, computed, 1e-3)


def observation(state, distances, scenario):
    """As a controller makes it of the messages that it receives."""
    received = conversions.to_distances(transmitted(distances))
    return conversions.to_observation(transmitted(state), received, scenario)


def test_an_observation_is_the_simulation_s_state(state, distances, simulation, scenario):
    seen = observation(state, distances, scenario)
    assert find_fault(seen, len(FILE_ORDER)) == ""
    assert (seen.cycle, seen.time) == (150, pytest.approx(1.5))
    for name in ("positions", "points", "displaced_agents", "displacements", "ready"):
        expected = getattr(simulation, name)()
        np.testing.assert_array_equal(getattr(seen, name), expected, err_msg=name)
        assert getattr(seen, name).shape == expected.shape
    assert not seen.ready[-1] and seen.ready[:-1].all()


def test_measured_velocities_come_in_the_scenario_s_order(state, distances, scenario):
    seen = conversions.to_observation(transmitted(state), transmitted(distances), scenario)
    assert seen.velocities is None
    velocities = np.arange(3.0 * len(state.agents)).reshape(-1, 3)
    state.measured_velocities = velocities.ravel()
    seen = conversions.to_observation(transmitted(state), transmitted(distances), scenario)
    order = conversions.agent_order(state, scenario)
    np.testing.assert_array_equal(seen.velocities, velocities[order])
    state.measured_velocities = np.zeros(2)
    with pytest.raises(conversions.MessageError, match="measured_velocities"):
        conversions.to_observation(transmitted(state), transmitted(distances), scenario)


@pytest.mark.parametrize("cycles, late", [(-3.5, 0), (0.0, 0), (0.95, 0), (1.05, 1), (2.95, 2)])
def test_a_state_s_age_tells_by_how_many_cycles_its_answer_is_late(
    state, distances, scenario, cycles, late
):
    received = conversions.to_distances(transmitted(distances))
    age = cycles * scenario.cycle_time
    seen = conversions.to_observation(transmitted(state), received, scenario, age)
    assert seen.lateness == pytest.approx(late * scenario.cycle_time)


def test_distances_arrive_as_they_were_computed(distances, computed):
    received = conversions.to_distances(transmitted(distances))
    for name, expected in fields_of(computed).items():
        np.testing.assert_array_equal(getattr(received, name), expected, err_msg=name)
        assert getattr(received, name).shape == expected.shape, name
    assert received.names == computed.names == ("ground",)


def test_no_obstacle_gives_no_feature_and_an_infinite_distance(state, scenario, computed):
    copies = len(state.displaced_agents)
    nothing = type(computed)(
        minimum=np.full(copies, np.inf),
        offsets=np.zeros(copies + 1, dtype=int),
        distance=np.zeros(0),
        obstacle=np.zeros(0, dtype=int),
        object_point=np.zeros((0, 3)),
        obstacle_point=np.zeros((0, 3)),
        normal=np.zeros((0, 3)),
        vertices=np.zeros((0, 3), dtype=int),
        weights=np.zeros((0, 3)),
        obstacle_velocity=np.zeros((0, 3)),
    )
    message = conversions.fill_distances(distances_message(), state, nothing, 0.0)
    seen = observation(state, message, scenario)
    assert find_fault(seen, len(FILE_ORDER)) == ""
    assert np.isinf(seen.distances.minimum).all()


def test_distances_carry_the_cycle_of_their_state(state, distances):
    assert distances.header == state.header
    assert (distances.cycle, distances.reset_count) == (state.cycle, state.reset_count)
    assert distances.computation_time == 1e-3


@pytest.mark.parametrize(
    "field, change",
    [
        ("points", lambda state: state.points[:-1]),
        ("agent_positions", lambda state: state.agent_positions[:-3]),
        ("displacements", lambda state: []),
        ("copy_ready", lambda state: state.copy_ready[:-1]),
        ("agents", lambda state: ["leader", "middle_assistant", "somebody"]),
        ("displaced_agents", lambda state: [3] + state.displaced_agents[1:]),
        ("displaced_agents", lambda state: [-2] + state.displaced_agents[1:]),
    ],
)
def test_a_state_that_does_not_fit_is_refused_by_name(state, distances, scenario, field, change):
    setattr(state, field, change(state))
    with pytest.raises(MessageError, match="^" + field):
        observation(state, distances, scenario)


def test_a_state_in_another_frame_is_refused(state, distances, scenario):
    state.header.frame_id = "odom"
    with pytest.raises(MessageError, match="state.header.frame_id: 'odom'.*'map'"):
        observation(state, distances, scenario)


def test_any_message_in_another_frame_is_refused_by_its_name(distances, scenario):
    conversions.require_frame("distances", distances, scenario)
    distances.header.frame_id = "odom"
    with pytest.raises(MessageError, match="distances.header.frame_id: 'odom'.*'map'"):
        conversions.require_frame("distances", distances, scenario)


@pytest.mark.parametrize(
    "field",
    [
        "object_points",
        "obstacle_points",
        "normals",
        "feature_vertices",
        "feature_weights",
        "feature_offsets",
        "minimum_distances",
        "feature_obstacles",
    ],
)
def test_distances_that_do_not_fit_are_refused_by_name(distances, field):
    setattr(distances, field, getattr(distances, field)[:-1])
    named = {"feature_offsets": "offsets", "minimum_distances": "offsets"}
    named["feature_obstacles"] = "obstacle"
    with pytest.raises(MessageError, match="^" + named.get(field, field)):
        conversions.to_distances(transmitted(distances))


def test_the_velocities_of_obstacles_are_sent_where_one_moves(state, computed):
    velocity = np.arange(3.0 * len(computed.distance)).reshape(-1, 3)
    moved = changed(computed, obstacle_velocity=velocity)
    pose = np.arange(7.0)[None]
    message = conversions.fill_distances(distances_message(), state, moved, 0.0, ["ground"], pose)
    received = transmitted(message)
    assert (received.moving_obstacles, list(received.obstacle_poses)) == (["ground"], list(pose[0]))
    np.testing.assert_array_equal(conversions.to_distances(received).obstacle_velocity, velocity)
    message.obstacle_velocities = message.obstacle_velocities[:-1]
    with pytest.raises(MessageError, match="^obstacle_velocities"):
        conversions.to_distances(transmitted(message))


def test_distances_that_are_unusable_say_so(state, scenario):
    copies = len(state.displaced_agents)
    message = conversions.fill_distances(
        distances_message(), state, Distances.unknown(copies, ("ground",)), 0.0, fault="it is lost"
    )
    with pytest.raises(MessageError, match="^it is lost$"):
        conversions.to_distances(transmitted(message))
    message.fault = ""
    # Nor are they taken for those of a run without obstacles.
    unknown = conversions.to_distances(transmitted(message))
    seen = conversions.to_observation(transmitted(state), unknown, scenario)
    assert "distances.minimum" in find_fault(seen, len(FILE_ORDER))


def test_a_decision_as_a_message(state, scenario):
    decision = ClosedLoop(scenario).step().decisions["end_assistant"]
    message = conversions.fill_controller_state(ControllerState(), state, "end_assistant", decision)
    received = transmitted(message)
    assert received.header == state.header
    assert (received.cycle, received.reset_count) == (150, 2)
    assert (received.agent, received.enabled) == ("end_assistant", True)
    assert (received.status, received.status_text) == (decision.status, decision.text)
    for name, vector in (
        ("position", decision.position),
        ("target", decision.target),
        ("error", decision.error),
        ("nominal_velocity", decision.nominal),
        ("velocity", decision.command),
        ("jacobian", decision.jacobian),
    ):
        assert [getattr(received, f"{name}_{axis}") for axis in "xyz"] == vector.tolist(), name
    for name in (
        "error_norm",
        "distance",
        "leader_drift",
        "rows",
        "solve_time",
        "computation_time",
    ):
        value = getattr(decision, name)
        assert getattr(received, name) == value or math.isnan(value), name
    assert dict(zip(received.barriers, received.h)) == decision.h
    assert dict(zip(received.barriers, received.slack)) == decision.slack
    for name in ("collision", "overstretch", "proximity"):
        assert getattr(received, f"h_{name}") == decision.h[name]
        assert getattr(received, f"slack_{name}") == decision.slack[name]


def test_a_command_answers_its_state(state):
    twist = conversions.to_twist(TwistStamped(), state, np.array([0.1, -0.2, 0.3]))
    assert twist.header == state.header
    linear, angular = twist.twist.linear, twist.twist.angular
    assert (linear.x, linear.y, linear.z) == (0.1, -0.2, 0.3)
    assert (angular.x, angular.y, angular.z) == (0.0, 0.0, 0.0)


def path_message(scenario, stamp=12.49):
    """A leader's announcement that answers the state before ``state``."""
    before = state_message(stamp=stamp, cycle=149)
    times = 1.49 + np.array([0.0, 0.2, 0.4])
    intent = Intent(times, np.array([[0.0, 0.0, 1.0], [0.0, 0.02, 1.0], [0.0, 0.05, 0.9]]))
    cycle_time = scenario.cycle_time
    path = conversions.fill_path(NavigationPath(), before, cycle_time, scenario.frame, intent)
    return transmitted(path), intent


def test_an_announcement_keeps_its_times_and_places(scenario, state):
    message, sent = path_message(scenario)
    got = conversions.to_leader_intent(message, state, scenario)
    assert message.header.stamp.to_sec() == pytest.approx(12.49)
    np.testing.assert_allclose(got.times, sent.times, atol=2e-9)
    np.testing.assert_array_equal(got.positions, sent.positions)


def test_nothing_announced_is_an_empty_path(scenario):
    before = state_message(stamp=12.49, cycle=149)
    message = conversions.fill_path(
        NavigationPath(), before, scenario.cycle_time, scenario.frame, None
    )
    assert not message.poses and message.header.frame_id == scenario.frame


def _other_frame(message):
    message.header.frame_id = "odom"


def _out_of_order(message):
    message.poses[1].header.stamp = message.poses[0].header.stamp


def _not_finite(message):
    message.poses[2].pose.position.z = math.nan


@pytest.mark.parametrize(
    "spoil, reason",
    [
        (_other_frame, "expected 'map'"),
        (_out_of_order, "not after the one before"),
        (_not_finite, "not finite"),
    ],
)
def test_announcements_that_cannot_be_used_say_why(scenario, state, spoil, reason):
    message, _ = path_message(scenario)
    spoil(message)
    with pytest.raises(MessageError, match=reason):
        conversions.to_leader_intent(message, state, scenario)
