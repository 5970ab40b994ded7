"""The independent solutions against closed forms and against one another."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from scipy.special import jn_zeros

from deformable_manipulation.validation.references.catenary import solve_catenary
from deformable_manipulation.validation.references.discrete_chain import ChainProblem, solve_chain
from deformable_manipulation.validation.references.elastica import (
    Clamped,
    Pinned,
    small_deflection,
    solve_between,
    solve_cantilever,
    solve_spans,
)
from deformable_manipulation.validation.references.kirchhoff import Ends, KirchhoffProblem
from deformable_manipulation.validation.references.swing import SwingingRod
from deformable_manipulation.validation.references.twist import (
    critical_moment_factor,
    critical_turn,
    reaction_torque,
)
from deformable_manipulation.validation.references.vibration import first_mode

GRAVITY = 9.81  # m/s^2


class TestCatenary:
    @pytest.mark.parametrize("chord", [(1.5, 0.0), (1.0, 0.7), (1.0, -0.7), (0.1, 0.0)])
    def test_ends_at_its_chord_with_its_length(self, chord):
        chain = solve_catenary(2.0, *chord)
        assert chain.positions([0.0, 2.0]) == pytest.approx(np.array([(0, 0), chord]), abs=1e-12)
        points = chain.positions(np.linspace(0.0, 2.0, 10001))
        assert np.linalg.norm(np.diff(points, axis=0), axis=1).sum() == pytest.approx(2.0, rel=1e-6)

    def test_is_in_balance(self):
        chain = solve_catenary(2.0, 1.2, 0.4)
        slope = np.tan(chain.angles([0.0, 2.0]))
        assert chain.scale * np.diff(slope) == pytest.approx([2.0])  # weight per length 1

    @pytest.mark.parametrize("chord", [(2.0, 0.0), (1.8, 1.0), (0.0, 1.0)])
    def test_refuses_what_it_cannot_span(self, chord):
        with pytest.raises(ValueError, match="does not hang"):
            solve_catenary(2.0, *chord)


class TestElastica:
    def test_a_stiff_cantilever_is_a_beam(self):
        length, stiffness, weight = 2.0, 300.0, 0.7
        tip = solve_cantilever(length, stiffness, weight).positions([length])[0]
        assert -tip[1] == pytest.approx(small_deflection(length, stiffness, weight), rel=1e-4)

    def test_small_deflection_all_along_the_beam(self):
        shape = solve_cantilever(1.0, 1000.0, 1.0)
        s = np.linspace(0.0, 1.0, 11)
        beam = s**2 * (6.0 - 4.0 * s + s**2) / 24.0 / 1000.0
        assert -shape.positions(s)[:, 1] == pytest.approx(beam, abs=1e-9)

    def test_the_clamp_carries_weight_and_moment(self):
        shape = solve_cantilever(1.5, 0.2, 0.7, angle=0.3)
        s = np.linspace(0.0, 1.5, 4001)
        x = shape.positions(s)[:, 0]
        arm = np.sum(0.5 * (x[1:] + x[:-1])) * (s[1] - s[0])
        assert shape.forces([0.0])[0] == pytest.approx([0.0, -0.7 * 1.5], abs=1e-9)
        assert shape.moments([0.0])[0] == pytest.approx(-0.7 * arm, rel=1e-6)

    def test_a_limp_rod_between_pins_is_a_catenary(self):
        shape = solve_between(2.0, 1e-5, 0.7, (1.5, 0.2), Pinned(), Pinned())
        chain = solve_catenary(2.0, 1.5, 0.2)
        s = np.linspace(0.0, 2.0, 101)
        assert shape.positions(s) == pytest.approx(chain.positions(s), abs=1e-4)
        assert shape.forces([0.0])[0, 0] == pytest.approx(0.7 * chain.scale, rel=1e-4)

    def test_a_clamped_limp_rod_has_the_moment_of_its_boundary_layer(self):
        stiffness = 1e-5
        shape = solve_between(2.0, stiffness, 0.7, (1.5, 0.0), Clamped(), Clamped())
        # Next to a clamp a string of tension T has m = 2 sqrt(EI T) sin(a/2), a off its line.
        angle = -solve_catenary(2.0, 1.5).angles([0.0])[0]
        tension = 0.7 * np.hypot(solve_catenary(2.0, 1.5).scale, 1.0)
        layer = -2.0 * np.sqrt(stiffness * tension) * np.sin(0.5 * angle)
        assert shape.moments([0.0])[0] == pytest.approx(layer, rel=0.02)

    def test_spans_over_a_pin_that_carries_nothing_are_one_rod(self):
        whole = solve_between(2.0, 0.05, 0.7, (1.5, 0.0), Clamped(), Pinned())
        middle = whole.positions([1.2])[0]
        places = [(0.0, 0.0), middle, (1.5, 0.0)]
        first, second = solve_spans([1.2, 0.8], 0.05, 0.7, places, Clamped(), Pinned())
        assert first.forces([1.2])[0] == pytest.approx(second.forces([0.0])[0], abs=1e-6)
        assert second.positions([0.5])[0] == pytest.approx(whole.positions([1.7])[0], abs=1e-7)


class TestDiscreteChain:
    def test_two_links_hang_as_statics_says(self):
        # Held at the centres of the first and third segment, without bending: a symmetric V whose
        # sides have half a segment, with a level middle segment.
        length, weight = 0.4, 2.0
        places = np.array([[0.0, 0.0], [0.7, 0.0]])
        chain = ChainProblem(length, 1e-12, weight, [0, 2], places, {}).solve(
            np.array([-0.5, 0.0, 0.5])
        )
        side = np.arccos((0.7 - length) / length)
        assert chain.angles == pytest.approx([-side, 0.0, side], abs=1e-9)
        total = 3.0 * weight * length
        assert chain.grip_forces[:, 1] == pytest.approx([-0.5 * total, -0.5 * total])
        # The inner half of a side segment balances the outer one: half the middle's weight alone.
        tension = 0.5 * weight * length / np.tan(side)
        assert chain.grip_forces[:, 0] == pytest.approx([tension, -tension])

    def test_converges_to_the_elastica_with_second_order(self):
        errors = []
        for segments in (41, 81):
            shape = solve_between(2.0, 0.05, 0.7, (1.5, 0.1), Clamped(), Clamped())
            chain = solve_chain(shape, segments, 0.05, 0.7, Clamped(), Clamped())
            truth = shape.positions(np.linspace(0.0, 2.0, segments))
            errors.append(np.abs(chain.centres() - truth).max())
        assert errors[1] < 1e-3
        assert np.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.1)


def _helix_point(axis, rate, s):
    """Where a curve is whose tangent, x at the start, turns about a unit axis at a rate [rad/m]."""
    along = axis[0] * axis
    across = np.array([1.0, 0.0, 0.0]) - along
    turned = np.cross(axis, across)
    angle = rate * s
    return s * along + (np.sin(angle) * across + (1.0 - np.cos(angle)) * turned) / rate


class TestKirchhoff:
    def test_in_a_plane_it_is_the_elastica(self):
        shape = solve_between(2.0, 0.1, 0.7, (1.5, 0.0), Clamped(), Clamped())
        problem = KirchhoffProblem(2.0, 0.1, 0.05, 0.7)
        rod = problem.follow([Ends((1.5, 0.0, 0.0))], problem.nodes(), problem.planar_guess(shape))
        s = np.linspace(0.0, 2.0, 21)
        assert rod.positions(s)[:, ::2] == pytest.approx(shape.positions(s), abs=1e-6)
        assert rod.moments([0.0])[0] == pytest.approx(
            [0.0, -shape.moments([0.0])[0], 0.0], abs=1e-6
        )

    def test_a_helix_has_its_bending_and_twisting_moment(self):
        # Without weight a helix is in balance; its Frenet frame turns about a fixed vector.
        length, curvature, torsion, twist = 2.0, 1.1, 0.6, 0.9
        problem = KirchhoffProblem(length, 0.1, 0.05)
        axis = np.array([torsion, 0.0, curvature])  # of the frame t = x, n = y, b = z
        s = length * problem.nodes()
        frames = Rotation.from_rotvec(np.outer(s, axis))
        own = Rotation.from_rotvec(np.outer(s, [twist - torsion, 0.0, 0.0]))
        tangents = frames.apply([1.0, 0.0, 0.0])
        steps = 0.5 * (tangents[1:] + tangents[:-1]) * np.diff(s)[:, None]
        points = np.vstack([np.zeros(3), np.cumsum(steps, axis=0)])
        rate = np.linalg.norm(axis)
        end = _helix_point(axis / rate, rate, length)
        assert points[-1] == pytest.approx(end, abs=1e-4)
        quaternions = (frames * own).as_quat()
        guess = np.vstack([points.T / length, quaternions.T, np.zeros((6, len(s)))])
        rotation = (frames * own)[-1].as_rotvec()
        rod = problem.follow([Ends(end, rotation)], problem.nodes(), guess)
        assert rod.moments([0.0])[0] == pytest.approx(
            [0.05 * twist, 0.0, 0.1 * curvature], abs=1e-5
        )
        assert rod.positions([1.0])[0] == pytest.approx(
            _helix_point(axis / rate, rate, 1.0), abs=1e-6
        )

    def test_a_moved_rod_is_in_balance(self):
        shape = solve_between(2.0, 0.1, 0.7, (1.5, 0.0), Clamped(), Clamped())
        problem = KirchhoffProblem(2.0, 0.1, 0.05, 0.7)
        path = [Ends((1.5, 0.1 * k, 0.0), (0.2 * k, 0.0, 0.1 * k)) for k in (1, 2, 3)]
        rod = problem.follow(path, problem.nodes(), problem.planar_guess(shape))
        s = np.linspace(0.0, 2.0, 4001)
        points = rod.positions(s)
        forces, moments = rod.forces([0.0, 2.0]), rod.moments([0.0, 2.0])
        centres = 0.5 * (points[1:] + points[:-1])
        weights = np.array([0.0, 0.0, -0.7]) * (s[1] - s[0])
        assert np.linalg.norm(np.diff(points, axis=0), axis=1) == pytest.approx(s[1], rel=1e-4)
        assert forces[1] - forces[0] + 4000 * weights == pytest.approx(np.zeros(3), abs=1e-6)
        arms = np.cross(points[-1], forces[1]) + np.cross(centres, weights).sum(axis=0)
        assert moments[1] - moments[0] + arms == pytest.approx(np.zeros(3), abs=1e-5)


class TestTwist:
    def test_critical_constant(self):
        assert critical_moment_factor() == pytest.approx(8.9868, abs=5e-5)
        assert critical_turn(3.0, 2.0) == pytest.approx(1.5 * 8.9868, rel=1e-5)

    def test_torque_before(self):
        assert reaction_torque(0.05, 2.0, 1.5) == pytest.approx(0.0375)

    def test_it_is_where_the_straight_rod_is_neutral(self):
        # Linearised without thrust, w = y + iz: w'''' = i (M / EI) w''', clamped at both ends.
        def smallest_singular_value(moment):
            root = 1j * moment
            rows = [
                [1.0, 0.0, 0.0, 1.0],
                [0.0, 1.0, 0.0, root],
                [1.0, 1.0, 1.0, np.exp(root)],
                [0.0, 1.0, 2.0, root * np.exp(root)],
            ]
            return np.linalg.svd(np.array(rows), compute_uv=False)[-1]

        factor = critical_moment_factor()
        assert smallest_singular_value(factor) < 1e-12
        below = [smallest_singular_value(moment) for moment in np.linspace(1.0, 8.5, 50)]
        assert min(below) > 1e-3


class TestVibration:
    def test_clamped_beam(self):
        mode = first_mode(2.0, 3.0, 0.07)
        beam = 1.87510407**2 * np.sqrt(3.0 / (0.07 * 2.0**4))
        assert mode.frequency == pytest.approx(beam, rel=1e-7)
        assert mode.shape(0.0) == pytest.approx(0.0)

    def test_hanging_chain(self):
        mode = first_mode(2.0, 1e-9, 0.07, 0.07 * GRAVITY, clamped=False)
        chain = 0.5 * jn_zeros(0, 1)[0] * np.sqrt(GRAVITY / 2.0)
        assert mode.frequency == pytest.approx(chain, rel=1e-6)


class TestSwing:
    def test_a_rigid_rod_is_a_physical_pendulum(self):
        length = 1.0
        period = 2.0 * np.pi * np.sqrt(2.0 * length / (3.0 * GRAVITY))
        times = period * np.array([0.0, 0.25, 0.5, 1.0])
        rod = SwingingRod(length, 1.0, 0.07, GRAVITY, damping=0.0, polynomials=1)
        end = rod.swing(0.01, times, np.array([length]))[:, 0, 0]
        assert end == pytest.approx(0.01 * np.array([1.0, 0.0, -1.0, 1.0]), abs=1e-6)

    def test_energy_is_kept_without_damping(self):
        length, mass, dt = 1.0, 0.07, 1e-3
        arcs = np.linspace(0.0, length, 201)
        rod = SwingingRod(length, 0.0, mass, GRAVITY, damping=0.0, polynomials=4)
        path = rod.swing(0.5, np.arange(0.0, 0.6, dt), arcs)
        speeds = (path[2:] - path[:-2]) / (2.0 * dt)
        energy = 0.5 * np.sum(speeds**2, axis=-1) + GRAVITY * path[1:-1, :, 1]
        along = 0.5 * mass * np.sum(energy[:, 1:] + energy[:, :-1], axis=1) * arcs[1]
        released = -mass * GRAVITY * 0.5 * length**2 * np.cos(0.5)
        assert np.ptp(path[-1, :, 0] / path[-1, -1, 0] - arcs) > 0.01  # it does bend
        assert along == pytest.approx(np.full(len(along), released), rel=1e-4)

    def test_damping_slows_the_pendulum(self):
        rod = SwingingRod(1.0, 1.0, 0.07, GRAVITY, damping=0.8, polynomials=1)
        frequency = np.sqrt(1.5 * GRAVITY - 0.4**2)
        times = np.array([0.0, 2.0 * np.pi / frequency])
        end = rod.swing(0.01, times, np.array([1.0]))[:, 0, 0]
        assert end[1] / end[0] == pytest.approx(np.exp(-0.4 * times[1]), rel=1e-3)
