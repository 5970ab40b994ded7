"""Grips that turn: errors by the logarithm, rows, the three kinds of control, what is refused."""

import dataclasses

import control_builders as build
import numpy as np
import pytest
import test_loads as loads
from scipy.spatial.transform import Rotation

from deformable_manipulation import _control, _pbd
from deformable_manipulation.control.status import Status
from deformable_manipulation.control.team import TeamController
from deformable_manipulation.reading.errors import ScenarioError
from deformable_manipulation.running.closed_loop import ClosedLoop
from deformable_manipulation.scenario import load_scenario

STEP = 1e-5  # rad
FREE = ("controller.orientation", "free")
FOLLOW = ("controller.orientation", "follow")


class TurnedRod:
    """Equilibria of the rod of test_loads.py, with its grips turned."""

    def __init__(self):
        self._rod = _pbd.Rod(
            length=loads.LENGTH,
            radius=0.004,
            density=1500.0,
            segments=loads.SEGMENTS,
            young_modulus=2e8,
            torsion_modulus=7e7,
            stretch="zero",
            damping=10.0,
            solver="direct",
            gravity=loads.GRAVITY,
            orientation=loads.ALONG_Y,
        )
        for particle, position in zip(loads.PARTICLES, loads.HELD):
            self._rod.hold(particle, "clamped", position, loads.ALONG_Y)
        self._rod.lay_out()
        assert self._rod.settle(0.01, 2, 1e-8, 60.0)
        self._found = _pbd.RodEquilibrium()

    def shape(self, turns):
        """With the grips turned by rotation vectors (3, 3) [rad]."""
        for particle, position, turn in zip(loads.PARTICLES, loads.HELD, turns):
            turned = Rotation.from_rotvec(turn) * Rotation.from_quat(loads.ALONG_Y)
            self._rod.set_pose(particle, position, turned.as_quat())
        found = self._found
        found.update(self._rod, tolerance=1e-10)
        assert found.valid(), found.status()
        return _control.ObjectShape(
            3,
            found.points(),
            found.response(),
            found.wrenches(),
            found.wrench_response(),
            turning=found.turning_response(),
        )


@pytest.fixture(scope="module")
def turned_rod():
    return TurnedRod()


def turning_barrier(name):
    section = {"reserve": 0.0, "alpha": [1.0, 2.0], **loads.sections()[name]}
    members = _control.Team(
        agents=3,
        leader=0,
        assistants=[1, 2],
        commanded=[1, 2],
        max_velocity=1e9,
        formulation=_control.Formulation.full(),
        max_angular_velocity=1e9,
    )
    return _control.Barrier(name, section, members)


@pytest.mark.parametrize("name", ["bending", "grip_force", "grip_torque", "tension"])
def test_rows_are_the_gradients_by_turns(turned_rod, name):
    """Behind the velocities of all assistants, and in the bound for the leader, who turns, too."""
    native = turning_barrier(name)
    shape = turned_rod.shape(np.zeros((3, 3)))
    state = _control.PredictedState(
        loads.HELD, np.zeros((3, 3)), angular_velocities=np.zeros((3, 3))
    )
    state.set_shape(shape)
    rows = native.rows(build.NO_FEATURES, state)
    assert rows.coefficients.shape[1] == 12
    nearest = np.argmax(rows.bounds)
    rates = np.empty((3, 3))
    for agent in range(3):
        for axis in range(3):
            ends = []
            for sign in (1.0, -1.0):
                turns = np.zeros((3, 3))
                turns[agent, axis] = sign * STEP
                ends.append(native.value(loads.HELD, np.inf, 1, turned_rod.shape(turns)))
            rates[agent, axis] = (ends[0] - ends[1]) / (2.0 * STEP)
    gradient = rows.coefficients[nearest, 6:] / loads.SCALE
    np.testing.assert_allclose(gradient, rates[1:].ravel(), rtol=1e-4, atol=1e-5)
    leading = np.array([[0.3, -0.2, 0.1], [0.0] * 3, [0.0] * 3])
    turning = _control.PredictedState(loads.HELD, np.zeros((3, 3)), angular_velocities=leading)
    turning.set_shape(shape)
    bound = native.rows(build.NO_FEATURES, turning).bounds[nearest]
    drift = rates[0] @ leading[0]
    assert bound == pytest.approx(rows.bounds[nearest] - loads.SCALE * drift, abs=1e-6)


def pole(*overrides, duration=0.1):
    """The scenario of a pole whose grips turn, for a moment."""
    return load_scenario(
        "tent_pole_one_assistant", [("simulation.duration", str(duration)), *overrides]
    )


def observed(scenario):
    loop = ClosedLoop(scenario)
    return loop._observer.observe()


def turned(observation, agent, turn):
    """The observation with one grip turned by a rotation vector [rad]."""
    orientations = observation.orientations.copy()
    orientations[agent] = (
        Rotation.from_rotvec(turn) * Rotation.from_quat(orientations[agent])
    ).as_quat()
    return dataclasses.replace(observation, orientations=orientations)


def unfiltered(scenario):
    return TeamController(scenario, ["assistant_1"], safety=False)


@pytest.mark.parametrize("angle", [0.0, 1e-6, 0.5, 2.0, 3.1])
def test_the_orientation_error_is_the_rotation_vector(angle):
    scenario = pole()
    turn = angle * np.array([0.6, 0.0, 0.8])
    decision = unfiltered(scenario).update(turned(observed(scenario), 1, turn))["assistant_1"]
    np.testing.assert_allclose(decision.orientation_error, -turn, atol=1e-7)
    gain = scenario.controller.turning_gain
    np.testing.assert_allclose(decision.angular_nominal, -gain * turn, atol=1e-7)


def test_the_orientation_error_does_not_jump_beyond_half_a_turn():
    scenario = pole()
    controller, start = unfiltered(scenario), observed(scenario)
    errors = []
    for k in range(80):
        state = dataclasses.replace(start, time=0.01 * k, cycle=k)
        decision = controller.update(turned(state, 1, np.array([0.05 * k, 0.0, 0.0])))
        errors.append(decision["assistant_1"].orientation_error[0])
    steps = np.diff(errors)
    assert errors[-1] < -np.pi
    assert np.abs(steps).max() < 0.06  # rad, the turn of a cycle and what is predicted


def test_follow_turns_the_formation_with_the_leader():
    """Place, grip, and both velocities."""
    scenario = pole(FOLLOW)
    controller, start = unfiltered(scenario), observed(scenario)
    rate, time = np.array([0.0, 0.0, 0.2]), 0.01
    controller.update(start)
    later = turned(dataclasses.replace(start, time=time, cycle=1), 0, time * rate)
    decision = controller.update(later)["assistant_1"]
    reference = start.positions[1] - start.positions[0]
    now = Rotation.from_rotvec(time * rate).apply(reference)
    np.testing.assert_allclose(decision.target, start.positions[0] + now, atol=1e-9)
    predicted = Rotation.from_rotvec(2.0 * time * rate).apply(reference)
    gains = scenario.controller.gain, scenario.controller.turning_gain
    velocity = gains[0] * (predicted - reference) + np.cross(rate, predicted)
    np.testing.assert_allclose(decision.nominal, velocity, atol=1e-6)
    np.testing.assert_allclose(
        decision.angular_nominal, gains[1] * 2.0 * time * rate + rate, atol=1e-6
    )


def test_free_grips_do_not_mind_the_leader_turning():
    scenario = pole()
    controller, start = unfiltered(scenario), observed(scenario)
    controller.update(start)
    later = turned(dataclasses.replace(start, time=0.01, cycle=1), 0, np.array([0.0, 0.0, 0.002]))
    decision = controller.update(later)["assistant_1"]
    np.testing.assert_allclose(decision.angular_nominal, 0.0, atol=1e-9)
    np.testing.assert_allclose(decision.nominal, 0.0, atol=1e-9)


def test_a_grip_keeps_its_limits_of_motion():
    scenario = pole(("controller.max_angular_velocity", "0.1"))
    controller, start = unfiltered(scenario), observed(scenario)
    far = turned(start, 1, np.array([1.0, -2.0, 0.0]))
    commands = []
    for k in range(20):
        state = dataclasses.replace(far, time=0.01 * k, cycle=k)
        commands.append(controller.update(state)["assistant_1"].angular_command)
    commands = np.array(commands)
    steps = np.diff(np.vstack((np.zeros((1, 3)), commands)), axis=0)
    limit = scenario.controller.max_angular_acceleration
    assert np.abs(steps).max() == pytest.approx(0.01 * limit)
    assert np.abs(commands[-1]) == pytest.approx([0.1, 0.1, 0.0], abs=1e-3)


@pytest.mark.parametrize(
    "fault, words",
    [
        (lambda o: dataclasses.replace(o, orientations=None), "does not tell the orientations"),
        (lambda o: dataclasses.replace(o, orientations=2.0 * o.orientations), "norm 2, not 1"),
        (lambda o: dataclasses.replace(o, orientations=np.nan * o.orientations), "not finite"),
        (lambda o: turned(o, 0, np.array([0.0, 0.5, 0.0])), "agent 0 leaps by 0.5 rad"),
    ],
)
def test_orientations_that_cannot_be_used_stop_the_assistants(fault, words):
    scenario = pole()
    controller, start = TeamController(scenario, ["assistant_1"]), observed(scenario)
    assert controller.update(start)["assistant_1"].status == Status.NOMINAL
    bad = fault(dataclasses.replace(start, time=0.01, cycle=1))
    decision = controller.update(bad)["assistant_1"]
    assert decision.status == Status.WAITING
    assert words in decision.text
    assert not decision.angular_command.any()


@pytest.mark.parametrize(
    "name, overrides, words",
    [
        ("stiff_rod_one_assistant", [FREE], "a pinned grip turns nothing: assistant_1"),
        ("stiff_rod_one_assistant", [FOLLOW], "pinned grip turns nothing: leader, assistant_1"),
        ("fabric_three_assistants", [FOLLOW], "one vertex of a fabric"),
        ("rope_one_assistant", [FREE, ("controller.jacobian", "perturbed_copies")], "copies"),
        ("rope_one_assistant", [FREE, ("knowledge.pose_noise", "0.001")], "imperfect knowledge"),
        ("rope_one_assistant", [("controller.orientation", "loose")], "one of fixed, follow, free"),
    ],
)
def test_grips_that_cannot_turn_are_refused(name, overrides, words):
    with pytest.raises(ScenarioError) as caught:
        load_scenario(name, overrides)
    told = [each.message for each in caught.value.problems if each.key == "controller.orientation"]
    assert any(words in message for message in told)


@pytest.mark.parametrize("cooperation", ["coordinated", "decentralised", "centralised"])
def test_two_assistants_turn_with_a_leader_who_turns(cooperation):
    """A rope whose leader turns about the vertical: all come around with it."""
    scenario = load_scenario(
        "rope_two_assistants",
        [
            FOLLOW,
            ("controller.cooperation", cooperation),
            ("controller.max_velocity", "1.0"),
            ("simulation.duration", "10.0"),
        ],
    )
    loop = ClosedLoop(scenario)
    leader, rate = scenario.leader_index, np.array([0.0, 0.0, 0.1])
    references = np.array([agent.start for agent in scenario.agents])
    references -= references[leader]
    for k in range(scenario.cycles):
        record = loop.step()
        loop._simulation.set_command(leader, np.zeros(3), rate if k < 500 else np.zeros(3))
    angle = 0.1 * 5.0
    places = record.positions[leader] + Rotation.from_rotvec([0.0, 0.0, angle]).apply(references)
    np.testing.assert_allclose(record.positions, places, atol=0.01)
    start = Rotation.from_quat([agent.orientation for agent in scenario.agents])
    now = Rotation.from_quat(loop._simulation.orientations())
    errors = (Rotation.from_rotvec([0.0, 0.0, angle]) * start * now.inv()).magnitude()
    assert errors.max() < 0.01
