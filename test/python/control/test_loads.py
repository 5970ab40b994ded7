"""Limits on what the object bears: gradients, closed loop, and what is refused."""

import control_builders as build
import numpy as np
import pytest
import yaml
from scipy.spatial.transform import Rotation
from scipy.special import ellipe, ellipk

from deformable_manipulation import _control, _pbd
from deformable_manipulation.control.status import Status
from deformable_manipulation.control.team import TeamController
from deformable_manipulation.reading.errors import ScenarioError
from deformable_manipulation.running.closed_loop import ClosedLoop
from deformable_manipulation.scenario import load_scenario, scenario_from_mapping
from deformable_manipulation.scenario.barriers import BARRIERS
from deformable_manipulation.scenario.mapping import scenario_to_mapping

SEGMENTS, LENGTH = 24, 2.0
HELD = np.array([[0.0, 0.0, 0.0], [0.05, 0.7, 0.1], [0.1, 1.5, 0.2]])
PARTICLES = (0, 12, 23)
ALONG_Y = (0.0, 0.0, np.sqrt(0.5), np.sqrt(0.5))
GRIPS = np.tile(ALONG_Y, (3, 1))
GRAVITY = np.array([0.0, 0.0, -9.81])
STEP = 1e-5  # m
FAR = 1e4  # in the unit of any load: a limit that nothing comes near to
SCALE = 10.0 / FAR  # of rows with gradients below a tenth of the limit


class HeldRod:
    """The equilibria of a rod that three agents hold; the pin lets bending through.

    Args:
        **more: what else the rod has.
    """

    def __init__(self, **more):
        self._rod = _pbd.Rod(
            length=LENGTH,
            radius=0.004,
            density=1500.0,
            segments=SEGMENTS,
            young_modulus=2e8,
            torsion_modulus=7e7,
            stretch="from_moduli",
            damping=10.0,
            solver="direct",
            gravity=GRAVITY,
            orientation=ALONG_Y,
            **more,
        )
        for particle, position, hold in zip(PARTICLES, HELD, ("clamped", "pinned", "clamped")):
            self._rod.hold(particle, hold, position, ALONG_Y)
        self._rod.lay_out()
        assert self._rod.settle(0.01, 2, 1e-8, 60.0)
        self._equilibrium = _pbd.RodEquilibrium()

    def shape(self, held, orientations=GRIPS):
        for particle, position, orientation in zip(PARTICLES, held, orientations):
            self._rod.set_pose(particle, position, orientation)
        found = self._equilibrium
        found.update(self._rod, tolerance=1e-10)
        assert found.valid(), found.status()
        return _control.ObjectShape(
            3,
            found.points(),
            found.response(),
            found.wrenches(),
            found.wrench_response(),
            found.turning_response(),
            orientations,
        )

    def points(self):
        return self._equilibrium.points()

    def wrenches(self):
        return self._equilibrium.wrenches()

    def settled(self, orientations):
        """The rod at rest with its grips turned."""
        for particle, position, orientation in zip(PARTICLES, HELD, orientations):
            self._rod.set_pose(particle, position, orientation)
        assert self._rod.settle(0.01, 2, 1e-8, 60.0)
        return self._rod

    def sections(self):
        """What barriers know of its segments, which are of unequal length."""
        joints, ends = list(self._rod.joint_lengths), np.array(self._rod.arc_lengths)
        masses = np.zeros((SEGMENTS, 2))
        masses[:, 0] = np.diff(ends) / (LENGTH / SEGMENTS)
        weights = {"masses": masses}
        edges = np.column_stack((np.arange(SEGMENTS), np.arange(SEGMENTS) + 1, np.diff(ends)))
        return {
            "bending": {"joint_lengths": joints},
            "tension": weights,
            "twist": weights,
            "strain": {"edges": edges},
        }


@pytest.fixture(scope="module")
def held_rod():
    return HeldRod()


@pytest.fixture(scope="module")
def gripped_rod():
    """Held by two grippers of a width, so that its segments are of unequal length."""
    return HeldRod(grips=[(0, 0.03), (12, None), (23, 0.05)])


def sections():
    """Sections of the barriers, derived keys and all, with limits that nothing comes near to."""
    mass = 1500.0 * np.pi * 0.004**2 * LENGTH / SEGMENTS
    ends = np.arange(SEGMENTS)
    edges = np.column_stack((ends, ends + 1, np.full(SEGMENTS, LENGTH / SEGMENTS)))
    masses = np.tile([1.0, 0.0], (SEGMENTS, 1))
    joints = {"weight": mass * GRAVITY, "masses": masses, "particles": list(PARTICLES)}
    stiffness = 7e7 * np.pi * 0.004**4 / 2.0
    return {
        "bending": {"min_radius": 1.0 / FAR, "joint_lengths": [LENGTH / SEGMENTS] * (SEGMENTS - 1)},
        "twist": {"max_twist": FAR, "torsion_stiffness": stiffness, **joints},
        "grip_force": {"max_force": FAR, "max_force_per_axis": [1e6] * 3},
        "grip_torque": {"max_torque": FAR, "max_torque_per_axis": [1e6] * 3},
        "tension": {"max_tension": FAR, **joints},
        "strain": {"max_strain": FAR, "edges": edges},
    }


def barrier(name, commanded=(1, 2), formulation=None, turns=False, **changes):
    section = {"reserve": 0.0, "alpha": [1.0, 2.0], **sections()[name], **changes}
    bounds = {"max_velocity": 1e9, "max_angular_velocity": 1e9 if turns else 0.0}
    formulation = formulation or _control.Formulation.full()
    members = build.team(commanded, [1, 2], 3, formulation, **bounds)
    return _control.Barrier(name, section, members)


def rows_of(native, shape, velocities=None, delay=0.0):
    state = _control.PredictedState(
        HELD, np.zeros((3, 3)) if velocities is None else velocities, delay=delay
    )
    state.set_shape(shape)
    return native.rows(build.NO_FEATURES, state)


@pytest.mark.parametrize("name", list(sections()))
def test_rows_are_the_gradients_by_differences(held_rod, name):
    """Of the load that is nearest to its limit, by the held points of both assistants.

    Where a gradient is small for the limit, all rows have the same scale.
    """
    _compare_with_differences(held_rod, barrier(name))


@pytest.mark.parametrize("name", list(sections()))
def test_rows_are_the_gradients_where_segments_are_unequal(gripped_rod, name):
    _compare_with_differences(gripped_rod, barrier(name, **gripped_rod.sections().get(name, {})))


def _compare_with_differences(held_rod, native):
    rows = rows_of(native, held_rod.shape(HELD))
    assert np.linalg.norm(rows.coefficients, axis=1).max() < 1.0
    nearest = np.argmax(rows.bounds)
    value = native.value(HELD, np.inf, 1, held_rod.shape(HELD))
    assert rows.bounds[nearest] == pytest.approx(-SCALE * value)
    differences = []
    for agent in (1, 2):
        for axis in np.eye(3):
            ends = []
            for sign in (1.0, -1.0):
                held = HELD.copy()
                held[agent] += sign * STEP * axis
                ends.append(native.value(held, np.inf, 1, held_rod.shape(held)))
            differences.append((ends[0] - ends[1]) / (2.0 * STEP))
    gradient = rows.coefficients[nearest] / SCALE
    assert np.abs(gradient).max() > 1e-5
    np.testing.assert_allclose(gradient, differences, rtol=1e-5, atol=1e-6)


def turned(orientation, rotation_vector):
    return (Rotation.from_rotvec(rotation_vector) * Rotation.from_quat(orientation)).as_quat()


#: Turned, so that the rod is twisted and the axes of the grips are not those of the fixed frame.
TURNED = np.array(
    [turned(ALONG_Y, turn) for turn in ((0.0, 0.7, 0.1), (0.0, 0.0, 0.0), (0.1, -0.4, 0.2))]
)

# What is limited along one axis alone, and an agent: most is borne by the leader or by itself.
ONE_AXIS = [
    ("grip_force", "max_force_per_axis", 0, 1),  # the leader
    ("grip_force", "max_force_per_axis", 2, 1),  # the agent itself
    ("grip_torque", "max_torque_per_axis", 1, 1),  # the leader
    ("grip_torque", "max_torque_per_axis", 2, 2),  # the agent itself
]


def differences(value):
    """Of value(held, orientations), by both assistants' held points, then by their turns."""
    result = []
    for part in ("moves", "turns"):
        for agent in (1, 2):
            for axis in np.eye(3):
                ends = []
                for sign in (1.0, -1.0):
                    held, orientations = HELD.copy(), TURNED.copy()
                    if part == "moves":
                        held[agent] += sign * STEP * axis
                    else:
                        orientations[agent] = turned(orientations[agent], sign * STEP * axis)
                    ends.append(value(held, orientations))
                result.append((ends[0] - ends[1]) / (2.0 * STEP))
    return np.array(result)


def check_turning_rows(held_rod, native, scale, agent=1):
    """The row of the load that is nearest to its limit is its gradient by moves and turns."""

    def value(held, orientations):
        return native.value(held, np.inf, agent, held_rod.shape(held, orientations))

    state = _control.PredictedState(HELD, np.zeros((3, 3)), angular_velocities=np.zeros((3, 3)))
    state.set_shape(held_rod.shape(HELD, TURNED))
    rows = native.rows(build.NO_FEATURES, state)
    nearest = np.argmin(np.abs(rows.bounds + scale * value(HELD, TURNED)))
    assert rows.bounds[nearest] == pytest.approx(-scale * value(HELD, TURNED), rel=1e-12)
    gradient = rows.coefficients[nearest] / scale
    expected = differences(value)
    np.testing.assert_allclose(gradient, expected, rtol=1e-4, atol=1e-5 * np.abs(expected).max())


@pytest.mark.parametrize("name", ["twist", "bending", "grip_torque"])
def test_rows_are_the_gradients_by_turns_too(held_rod, name):
    check_turning_rows(held_rod, barrier(name, turns=True), SCALE)


@pytest.mark.parametrize("name, key, axis, agent", ONE_AXIS)
def test_rows_per_axis_are_the_gradients(held_rod, name, key, axis, agent):
    """In the frame of the grip, which turns with it."""
    limits = np.full(3, 1e6)
    limits[axis] = 1e3
    native = barrier(name, turns=True, **{key: limits, "orientations": GRIPS})
    check_turning_rows(held_rod, native, 10.0 / 1e3, agent)


@pytest.mark.parametrize("name, key, axis, agent", ONE_AXIS)
def test_limits_per_axis_are_those_of_the_grips_frame(held_rod, name, key, axis, agent):
    """Of the agent and of the leader, either way; from the start, if orientations are not told."""
    limits = np.full(3, 1e6)
    limits[axis] = 1e3
    native = barrier(name, **{key: limits, "orientations": TURNED})
    shape = held_rod.shape(HELD, TURNED)
    wrenches = held_rod.wrenches()[:, :3] if name == "grip_force" else held_rod.wrenches()[:, 3:]
    own = Rotation.from_quat(TURNED).inv().apply(wrenches)[:, axis]
    untold = _control.ObjectShape(3, held_rod.points(), wrenches=held_rod.wrenches())
    for told in (shape, untold):
        assert 1e3 - native.value(HELD, np.inf, agent, told) == pytest.approx(
            np.abs(own[[0, agent]]).max()
        )


def test_the_twist_is_that_between_the_orientations_of_the_segments(held_rod):
    """The rod is at rest, turned and bent in space: about the axis of each joint."""
    settled = held_rod.settled(TURNED)
    orientations = Rotation.from_quat(settled.orientations())
    between = (orientations[:-1].inv() * orientations[1:]).as_quat()
    twists = 2.0 * np.arctan2(between[:, 0], between[:, 3]) / (LENGTH / SEGMENTS)
    found = _pbd.RodEquilibrium()
    found.update(settled, tolerance=1e-10)
    shape = _control.ObjectShape(3, found.points(), wrenches=found.wrenches())
    assert np.abs(twists).max() > 0.3  # rad/m
    largest = FAR - barrier("twist").value(HELD, np.inf, 1, shape)
    assert largest == pytest.approx(np.abs(twists).max(), rel=2e-3)


def test_tension_and_twist_know_the_weights_of_unequal_segments(gripped_rod):
    """Counted from the first grip on, they are what the rod's own equilibrium has in each joint."""
    settled = gripped_rod.settled(TURNED)
    orientations = Rotation.from_quat(settled.orientations())
    between = (orientations[:-1].inv() * orientations[1:]).as_quat()
    twists = 2.0 * np.arctan2(between[:, 0], between[:, 3]) / np.array(settled.joint_lengths)
    found = _pbd.RodEquilibrium()
    found.update(settled, tolerance=1e-10)
    shape = _control.ObjectShape(3, found.points(), wrenches=found.wrenches())
    sections = gripped_rod.sections()
    largest = FAR - barrier("twist", **sections["twist"]).value(HELD, np.inf, 1, shape)
    assert largest == pytest.approx(np.abs(twists).max(), rel=2e-3)
    ends = np.array(settled.arc_lengths)
    mass = 1500.0 * np.pi * 0.004**2
    tensions = []
    for joint in range(SEGMENTS - 1):
        held = np.array(PARTICLES) > joint
        force = (
            -found.wrenches()[held, :3].sum(axis=0) + mass * (LENGTH - ends[joint + 1]) * GRAVITY
        )
        along = found.points()[joint + 2] - found.points()[joint]
        tensions.append(force @ along / np.linalg.norm(along))
    native = barrier("tension", **sections["tension"])
    assert FAR - native.value(HELD, np.inf, 1, shape) == pytest.approx(max(tensions), rel=1e-6)


def test_rows_are_predicted_and_shared(held_rod):
    """Over the delay the load changes by the velocities relative to the leader's."""
    shape = held_rod.shape(HELD)
    velocities = np.array([[0.0, 0.1, 0.0], [0.02, 0.0, -0.05], [0.0, 0.03, 0.01]])
    whole = barrier("grip_force")
    now, then = rows_of(whole, shape), rows_of(whole, shape, velocities, delay=0.1)
    relative = np.concatenate([velocities[1] - velocities[0], velocities[2] - velocities[0]])
    gradients = now.coefficients
    np.testing.assert_allclose(then.coefficients, gradients)
    leading = gradients @ np.tile(velocities[0], 2)
    np.testing.assert_allclose(
        then.bounds, now.bounds - 0.1 * gradients @ relative + leading, atol=1e-12
    )
    parts = [rows_of(barrier("grip_force", [agent]), shape) for agent in (1, 2)]
    np.testing.assert_allclose(parts[0].bounds + parts[1].bounds, now.bounds)
    np.testing.assert_allclose(
        np.hstack([part.coefficients for part in parts]), gradients, atol=1e-12
    )


def test_what_is_not_known_limits_nothing(held_rod):
    unknown = _control.ObjectShape(3, np.zeros((SEGMENTS + 1, 3)))
    for name in ("twist", "grip_force", "grip_torque", "tension"):
        assert barrier(name).value(HELD, np.inf, 1, unknown) == np.inf
        assert barrier(name).value(HELD, np.inf, 1) == np.inf
    assert len(rows_of(barrier("bending"), unknown)) == 0


def test_the_curvature_of_a_polygon_is_that_of_its_circle():
    angles = np.linspace(0.0, 1.2, SEGMENTS + 1)
    radius = LENGTH / 1.2
    circle = radius * np.column_stack((np.cos(angles), np.sin(angles), 0.0 * angles))
    native = barrier("bending", min_radius=radius)
    shape = _control.ObjectShape(3, circle)
    assert native.value(HELD, np.inf, 1, shape) == pytest.approx(0.0, abs=1e-12)


class LightRod:
    """A rod of many segments that bends only as far as its two grips make it, along x.

    Attributes:
        length: between its held points [m].
        stiffness: of bending [N m^2].
    """

    segments, radius, young_modulus = 160, 0.003, 3.1e10

    def __init__(self, hold):
        self.rod = _pbd.Rod(
            length=LENGTH,
            radius=self.radius,
            density=1950.0,
            segments=self.segments,
            young_modulus=self.young_modulus,
            torsion_modulus=3.1e9,
            stretch="zero",
            damping=10.0,
            solver="direct",
            gravity=np.array([0.0, 0.0, -0.01]),  # says to which side
        )
        self.length = LENGTH * (self.segments - 1) / self.segments
        self.stiffness = self.young_modulus * np.pi * self.radius**4 / 4.0
        self._hold = hold

    def bear(self, positions, angles):
        """Largest curvature [1/m] and wrenches (2, 6), with grips turned about y [rad]."""
        for particle, position, angle in zip((0, self.segments - 1), positions, angles):
            orientation = (0.0, np.sin(0.5 * angle), 0.0, np.cos(0.5 * angle))
            self.rod.hold(particle, self._hold, position, orientation)
        self.rod.lay_out()
        assert self.rod.settle(0.01, 4, 1e-5, 120.0)
        found = _pbd.RodEquilibrium()
        found.update(self.rod, tolerance=1e-8, iterations=200)
        assert found.valid(), found.status()
        limit = 1e3
        lengths = [LENGTH / self.segments] * (self.segments - 1)
        section = {"min_radius": 1.0 / limit, "joint_lengths": lengths}
        native = barrier("bending", (1,), reserve=0.0, **section)
        shape = _control.ObjectShape(2, found.points())
        return limit - native.value(HELD, np.inf, 1, shape), found.wrenches()


def test_turned_clamps_bend_a_rod_into_a_circle():
    """Pure bending: curvature angle / length, torque E I times that, and no force."""
    rod, angle = LightRod("clamped"), 1.0
    chord = rod.length * np.sin(0.5 * angle) / (0.5 * angle)
    ends = [[0.0, 0.0, 0.0], [chord, 0.0, 0.0]]
    curvature, wrenches = rod.bear(ends, (-0.5 * angle, 0.5 * angle))
    torque = rod.stiffness * angle / rod.length
    assert curvature == pytest.approx(angle / rod.length, rel=0.01)
    assert np.abs(wrenches[:, 4]) == pytest.approx([torque, torque], rel=0.01)
    assert np.linalg.norm(wrenches[:, :3], axis=1).max() < 0.01 * torque / rod.length


@pytest.mark.parametrize("modulus", [0.3, 0.6])
def test_a_buckled_strut_is_the_elastica(modulus):
    """Pinned ends: force 4 K^2 E I / L^2, curvature in the middle 4 k K / L (Euler)."""
    rod = LightRod("pinned")
    first, second = ellipk(modulus**2), ellipe(modulus**2)
    chord = rod.length * (2.0 * second / first - 1.0)
    curvature, wrenches = rod.bear([[0.0, 0.0, 0.0], [chord, 0.0, 0.0]], (0.0, 0.0))
    force = 4.0 * first**2 * rod.stiffness / rod.length**2
    assert curvature == pytest.approx(4.0 * modulus * first / rod.length, rel=2e-3)
    np.testing.assert_allclose(np.abs(wrenches[:, 0]), force, rtol=2e-3)
    assert np.abs(wrenches[:, 3:]).max() < 1e-3 * force * rod.length


LIMITS = {
    "bending": {"min_radius": 0.09},
    "grip_torque": {"max_torque": 0.0715},
    "grip_force": {"max_force": 1.35},
    "tension": {"max_tension": 1.3},
}


def limited(*overrides, duration=68.0, **limits):
    """A rope over its first hill, which takes 68 s; over the second one, 104 s, it is taut."""
    sections = [("controller." + name, yaml.safe_dump(value)) for name, value in limits.items()]
    duration = ("simulation.duration", str(duration))
    return load_scenario("rope_one_assistant", [duration, *sections, *overrides])


def run(scenario):
    loop = ClosedLoop(scenario)
    return [loop.step().decisions["assistant_1"] for _ in range(scenario.cycles)]


def lowest(decisions, name):
    return min(decision.h[name] for decision in decisions)


def ten_times(name):
    """A limit ten times as wide, and by how much the one of LIMITS is tighter, in its unit."""
    (key, value), *_ = LIMITS[name].items()
    if name == "bending":
        return {key: value / 10.0}, 10.0 / value - 1.0 / value
    return {key: value * 10.0}, value * 9.0


def test_without_limits_the_rope_bears_more():
    wide = {name: ten_times(name) for name in LIMITS}
    decisions = run(limited(duration=104.0, **{name: wide[name][0] for name in wide}))
    for name, (_, tighter) in wide.items():
        assert lowest(decisions, name) < tighter, name


@pytest.mark.parametrize(
    "names, duration, overrides",
    [
        (("bending", "grip_torque"), 68.0, ()),
        (("bending",), 68.0, [("controller.jacobian", "perturbed_copies")]),
        (("grip_force", "tension"), 104.0, ()),
    ],
)
def test_limits_hold_while_the_rope_goes_over_hills(names, duration, overrides):
    limits = {name: LIMITS[name] for name in names}
    decisions = run(limited(*overrides, duration=duration, **limits))
    for name in (*names, "collision"):
        assert lowest(decisions, name) >= -1e-3, name
    assert any(decision.status == Status.CONSTRAINED for decision in decisions)
    assert not any(decision.status == Status.FAILED for decision in decisions)


def test_a_limit_below_the_load_at_rest_is_refused():
    scenario = limited(bending={"min_radius": 0.12}, grip_force={"max_force": 0.5})
    with pytest.raises(ScenarioError) as caught:
        ClosedLoop(scenario)
    problems = {problem.key: problem.message for problem in caught.value.problems}
    assert set(problems) == {"controller.bending", "controller.grip_force"}
    bent = "the object is bent too sharply at the start, by 1.87 1/m beyond the limit; loosen"
    assert problems["controller.bending"].startswith(bent)
    assert problems["controller.grip_force"].startswith("the force at a grip is too large at the")


def test_a_controller_does_not_begin_beyond_a_limit():
    """As under ROS, where nobody looks at the start but the controllers."""
    loop = ClosedLoop(limited(bending={"min_radius": 0.09}))
    observation = loop._observer.observe()
    tight = TeamController(limited(bending={"min_radius": 0.12}), ["assistant_1"])
    for _ in range(2):
        decision = tight.update(observation)["assistant_1"]
        assert decision.status == Status.WAITING
        assert "bent too sharply" in decision.text
        assert not decision.command.any()


def test_wrenches_that_are_not_told_stop_the_assistants():
    loop = ClosedLoop(limited(bending={"min_radius": 0.09}))
    observation = loop._observer.observe()
    decision = TeamController(limited(grip_force={"max_force": 2.0}), ["assistant_1"]).update(
        observation
    )["assistant_1"]
    assert decision.status == Status.WAITING
    assert "does not tell the wrenches" in decision.text


@pytest.mark.parametrize("name", ["bending", "twist", "grip_torque", "tension"])
def test_limits_of_rods_are_refused_for_fabrics(name):
    section = ("controller." + name, yaml.safe_dump({**LIMITS, "twist": {"max_twist": 1.0}}[name]))
    with pytest.raises(ScenarioError, match=f"controller.{name}.*for ropes and rods"):
        load_scenario("fabric_three_assistants", [section])


def test_a_scenario_with_limits_comes_back_from_its_mapping():
    scenario = limited(**LIMITS)
    assert scenario.controller.priority[-4:] == tuple(
        sorted(LIMITS, key=lambda name: BARRIERS[name].rank)
    )
    assert scenario_from_mapping(scenario_to_mapping(scenario), ".") == scenario


def test_a_load_is_shown_with_its_unit():
    assert BARRIERS["grip_torque"].show(0.01234) == "0.0123 N m"
    assert BARRIERS["strain"].show(0.5) == "0.5"
    assert BARRIERS["collision"].show(0.0123) == "12.3 mm"
    assert BARRIERS["bending"].show(None) == "none"
