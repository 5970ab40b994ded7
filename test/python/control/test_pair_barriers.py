import numpy as np
import pytest

from deformable_manipulation.control.barriers import Situation
from deformable_manipulation.control.class_k import PiecewiseLinearClassK
from deformable_manipulation.control.overstretch import OverstretchBarrier
from deformable_manipulation.control.proximity import ProximityBarrier

SLOPES = (1.0, 2.0)
LIMITS = np.array([1.3, 1.1, 0.9])
BARRIERS = [OverstretchBarrier, ProximityBarrier]


def situation(positions, leader_velocity=(0.0, 0.0, 0.0)):
    return Situation(
        positions=np.asarray(positions, dtype=float),
        velocities=np.zeros_like(positions, dtype=float),
        leader_velocity=np.asarray(leader_velocity, dtype=float),
        delay=0.01,
    )


@pytest.fixture(params=range(5))
def positions(request):
    return np.random.default_rng(request.param).normal(size=(3, 3))


@pytest.mark.parametrize("barrier", BARRIERS)
def test_gradient_by_differences(barrier, positions):
    barrier = barrier(1, 0, LIMITS, SLOPES)
    step = 1e-6
    columns = []
    for axis in range(3):
        moved = [positions.copy(), positions.copy()]
        moved[0][1, axis] -= step
        moved[1][1, axis] += step
        columns.append((barrier.value(moved[1]) - barrier.value(moved[0])) / (2.0 * step))
    np.testing.assert_allclose(barrier.gradient(positions), np.transpose(columns), atol=1e-8)


def test_values_are_the_margins(positions):
    ranges = np.linalg.norm(positions[[0, 2]] - positions[1], axis=1)
    limits = LIMITS[[0, 2]]
    overstretch = OverstretchBarrier(1, 0, LIMITS, SLOPES).value(positions)
    proximity = ProximityBarrier(1, 0, LIMITS, SLOPES).value(positions)
    np.testing.assert_allclose(overstretch, limits - ranges)
    np.testing.assert_allclose(proximity, ranges - limits)


@pytest.mark.parametrize("barrier", BARRIERS)
def test_row_against_the_leader_is_the_whole_constraint(barrier, positions):
    """g . u - bound is dh/dt + alpha(h), with dh/dt from moving both agents."""
    generator = np.random.default_rng(8)
    own, leader = generator.normal(size=(2, 3))
    barrier = barrier(1, 0, LIMITS, SLOPES)
    rows = barrier.rows(situation(positions, leader))
    step = 1e-6
    ahead, behind = positions.copy(), positions.copy()
    for moved, sign in ((ahead, 1.0), (behind, -1.0)):
        moved[0] += sign * step * leader
        moved[1] += sign * step * own
    rate = (barrier.value(ahead) - barrier.value(behind))[0] / (2.0 * step)
    alpha = PiecewiseLinearClassK(SLOPES)(barrier.value(positions)[0])
    assert rows.coefficients[0] @ own - rows.bounds[0] == pytest.approx(rate + alpha, abs=1e-7)


@pytest.mark.parametrize("barrier", BARRIERS)
def test_two_assistants_share_the_whole_constraint(barrier, positions):
    generator = np.random.default_rng(9)
    leader, first, second = generator.normal(size=(3, 3))
    one = barrier(1, 0, np.full(3, 1.1), SLOPES)
    two = barrier(2, 0, np.full(3, 1.1), SLOPES)
    scene = situation(positions, leader)
    shared = [
        rows.coefficients[1] @ u - rows.bounds[1]
        for rows, u in ((one.rows(scene), first), (two.rows(scene), second))
    ]
    direction = one.gradient(positions)[1]
    alpha = PiecewiseLinearClassK(SLOPES)(one.value(positions)[1])
    assert sum(shared) == pytest.approx(direction @ (first - second) + alpha)


@pytest.mark.parametrize("barrier", BARRIERS)
def test_a_formation_that_moves_with_the_leader_is_not_held_back(barrier):
    positions = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    limits = np.linalg.norm(positions - positions[1], axis=1)  # all margins are zero
    velocity = np.array([0.7, -0.4, 0.2])
    rows = barrier(1, 0, limits, SLOPES).rows(situation(positions, velocity))
    np.testing.assert_allclose(rows.coefficients @ velocity, rows.bounds, atol=1e-12)


@pytest.mark.parametrize("barrier", BARRIERS)
def test_coincident_points_have_a_direction_that_both_agents_agree_on(barrier):
    positions = np.zeros((3, 3))
    one = barrier(1, 0, LIMITS, SLOPES).gradient(positions)
    two = barrier(2, 0, LIMITS, SLOPES).gradient(positions)
    np.testing.assert_allclose(np.linalg.norm(one, axis=1), 1.0)
    np.testing.assert_array_equal(one[1], -two[1])
    assert np.isfinite(barrier(1, 0, LIMITS, SLOPES).rows(situation(positions)).bounds).all()
