import numpy as np
import pytest
from control_builders import PairBarrier

from deformable_manipulation._control import PiecewiseLinearClassK, PredictedState

SLOPES = (1.0, 2.0)
LIMITS = np.array([1.3, 1.1, 0.9])
KINDS = ["overstretch", "proximity"]


def state_of(positions, leader_velocity=(0.0, 0.0, 0.0), others=0.0):
    """Everybody else moves with a velocity of its own, which only the paper's rows look at."""
    velocities = np.full_like(positions, others, dtype=float)
    velocities[0] = leader_velocity
    return PredictedState(positions, velocities, leader=0, delay=0.01)


def barrier_of(kind, agent=1, limits=LIMITS, **settings):
    """Of one assistant, with its limits against each other agent."""
    symmetric = np.zeros((3, 3))
    symmetric[agent] = symmetric[:, agent] = limits
    return PairBarrier(kind, [agent], symmetric, SLOPES, **settings)


def value(barrier, positions):
    return np.array([barrier.value(positions, 1, other) for other in (0, 2)])


def gradient(barrier, positions, agent=1, others=(0, 2)):
    return np.array([barrier.gradient(positions, agent, other) for other in others])


@pytest.fixture(params=range(5))
def positions(request):
    return np.random.default_rng(request.param).normal(size=(3, 3))


@pytest.mark.parametrize("kind", KINDS)
def test_gradient_by_differences(kind, positions):
    barrier = barrier_of(kind)
    step = 1e-6
    columns = []
    for axis in range(3):
        moved = [positions.copy(), positions.copy()]
        moved[0][1, axis] -= step
        moved[1][1, axis] += step
        columns.append((value(barrier, moved[1]) - value(barrier, moved[0])) / (2.0 * step))
    np.testing.assert_allclose(gradient(barrier, positions), np.transpose(columns), atol=1e-8)


def test_values_are_the_margins(positions):
    ranges = np.linalg.norm(positions[[0, 2]] - positions[1], axis=1)
    limits = LIMITS[[0, 2]]
    overstretch = value(barrier_of("overstretch"), positions)
    proximity = value(barrier_of("proximity"), positions)
    np.testing.assert_allclose(overstretch, limits - ranges)
    np.testing.assert_allclose(proximity, ranges - limits)


@pytest.mark.parametrize("kind", KINDS)
def test_row_against_the_leader_is_the_whole_constraint(kind, positions):
    """g . u - bound is dh/dt + alpha(h), with dh/dt from moving both agents."""
    generator = np.random.default_rng(8)
    own, leader = generator.normal(size=(2, 3))
    barrier = barrier_of(kind)
    rows = barrier.rows(state_of(positions, leader))
    step = 1e-6
    ahead, behind = positions.copy(), positions.copy()
    for moved, sign in ((ahead, 1.0), (behind, -1.0)):
        moved[0] += sign * step * leader
        moved[1] += sign * step * own
    rate = (value(barrier, ahead) - value(barrier, behind))[0] / (2.0 * step)
    alpha = PiecewiseLinearClassK(*SLOPES)(barrier.value(positions, 1, 0))
    assert rows.coefficients[0] @ own - rows.bounds[0] == pytest.approx(rate + alpha, abs=1e-7)


@pytest.mark.parametrize("kind", KINDS)
def test_two_assistants_share_the_whole_constraint(kind, positions):
    generator = np.random.default_rng(9)
    leader, first, second = generator.normal(size=(3, 3))
    one = barrier_of(kind, 1, np.full(3, 1.1))
    two = barrier_of(kind, 2, np.full(3, 1.1))
    state = state_of(positions, leader)
    shared = [
        rows.coefficients[1] @ u - rows.bounds[1]
        for rows, u in ((one.rows(state), first), (two.rows(state), second))
    ]
    direction = one.gradient(positions, 1, 2)
    alpha = PiecewiseLinearClassK(*SLOPES)(one.value(positions, 1, 2))
    assert sum(shared) == pytest.approx(direction @ (first - second) + alpha)


@pytest.mark.parametrize("kind", KINDS)
def test_a_formation_that_moves_with_the_leader_is_not_held_back(kind):
    positions = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    limits = np.linalg.norm(positions - positions[1], axis=1)  # all margins are zero
    velocity = np.array([0.7, -0.4, 0.2])
    rows = barrier_of(kind, 1, limits).rows(state_of(positions, velocity))
    np.testing.assert_allclose(rows.coefficients @ velocity, rows.bounds, atol=1e-12)


@pytest.mark.parametrize("kind", KINDS)
def test_coincident_points_have_a_direction_that_both_agents_agree_on(kind):
    positions = np.zeros((3, 3))
    one = gradient(barrier_of(kind, 1), positions)
    two = gradient(barrier_of(kind, 2), positions, 2, (0, 1))
    np.testing.assert_allclose(np.linalg.norm(one, axis=1), 1.0)
    np.testing.assert_array_equal(one[1], -two[1])
    assert np.isfinite(barrier_of(kind).rows(state_of(positions)).bounds).all()


@pytest.mark.parametrize("kind", KINDS)
def test_rows_keep_a_margin_that_the_value_does_not_count(kind, positions):
    with_margin = barrier_of(kind, margin=0.005)
    np.testing.assert_array_equal(value(with_margin, positions), value(barrier_of(kind), positions))
    alpha = PiecewiseLinearClassK(*SLOPES)
    bound = with_margin.rows(state_of(positions)).bounds[0]
    assert bound == pytest.approx(-alpha(with_margin.value(positions, 1, 0) - 0.005))


@pytest.mark.parametrize("kind", KINDS)
def test_without_shares_each_answers_the_others_measured_velocity(kind, positions):
    """The paper's rows."""
    barrier = barrier_of(kind, shares=False)
    rows = barrier.rows(state_of(positions, (0.1, 0.0, -0.2), others=0.3))
    alpha = PiecewiseLinearClassK(*SLOPES)
    direction, h = barrier.gradient(positions, 1, 2), barrier.value(positions, 1, 2)
    wanted = direction @ np.full(3, 0.3) - alpha(h)
    assert rows.bounds[1] == pytest.approx(wanted)


def test_the_lowest_is_that_of_the_worst_pair(positions):
    barrier = barrier_of("overstretch")
    assert barrier.lowest(positions, 1) == value(barrier, positions).min()


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("commanded", [(1, 2), (2, 1)])
def test_a_row_of_two_commanded_together_is_the_whole_constraint(kind, commanded, positions):
    """One row per pair: two against the leader, one between the two, dh/dt from moving both."""
    leader, first, second = np.random.default_rng(9).normal(size=(3, 3))
    velocities = np.array([leader, first, second])
    barrier = PairBarrier(kind, list(commanded), np.full((3, 3), 1.1), SLOPES)
    rows = barrier.rows(state_of(positions, leader))
    found = rows.coefficients @ velocities[list(commanded)].ravel() - rows.bounds
    alpha = PiecewiseLinearClassK(*SLOPES)
    step, wanted = 1e-6, []
    for i, j in ((0, 1), (0, 2), (1, 2)):
        ends = [barrier.value(positions + sign * step * velocities, i, j) for sign in (-1.0, 1.0)]
        rate = (ends[1] - ends[0]) / (2.0 * step)
        wanted.append(rate + alpha(barrier.value(positions, i, j)))
    np.testing.assert_allclose(sorted(found), sorted(wanted), atol=1e-7)
