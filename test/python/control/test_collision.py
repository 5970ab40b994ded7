import control_builders as build
import numpy as np
import pytest

from deformable_manipulation._control import (
    Differences,
    Features,
    Formulation,
    PiecewiseLinearClassK,
    PredictedState,
)
from deformable_manipulation.scenario.spec import CollisionSpec

SLOPES, OFFSET = (1.0, 5.0), 0.05
NORMAL = np.array([2.0, -1.0, 2.0]) / 3.0


BAND = 1e6  # m: no row is loosened


def state_of(velocities, delay=0.0):
    return PredictedState(np.zeros_like(velocities), velocities, leader=0, delay=delay)


def formulation(**settings):
    """All that the limits have, one row per feature."""
    result = Formulation.full()
    result.anticipation = False
    for name, value in settings.items():
        setattr(result, name, value)
    return result


def setting(assistants, seed):
    """A linear object, a moving obstacle, held points, their velocities, and the features."""
    generator = np.random.default_rng(seed)
    body = build.random_object(generator, assistants + 1)
    obstacle = build.HalfSpace(NORMAL, -1.0, generator.normal(size=3))
    positions, velocities = generator.normal(size=(2, assistants + 1, 3))
    observation = build.observe(0.0, positions, body, obstacle)
    differences = Differences(assistants + 1, leader=0)
    differences.update(observation)
    return body, obstacle, positions, velocities, differences.features(observation)


def barriers(assistants, band=BAND, margin=0.0, speed_margin=0.0, snap_margin=0.0, **settings):
    everybody = list(range(1, assistants + 1))
    return [
        build.collision_barrier(
            [i],
            everybody,
            formulation(**settings),
            band=band,
            margin=margin,
            speed_margin=speed_margin,
            snap_margin=snap_margin,
        )
        for i in everybody
    ]


def distance_later(seconds, vertex, body, obstacle, positions, velocities):
    moved = body.points(positions + seconds * velocities)[vertex]
    return moved @ NORMAL - obstacle.at(seconds).level


@pytest.mark.parametrize("assistants", [1, 2, 3])
@pytest.mark.parametrize("seed", range(4))
def test_rows_sum_to_the_whole_constraint(assistants, seed):
    """Sum of g . u - bound over the assistants is dh/dt + alpha(h), h moved in time."""
    body, obstacle, positions, velocities, features = setting(assistants, seed)
    state = state_of(velocities)
    total = 0.0
    for barrier, velocity in zip(barriers(assistants), velocities[1:]):
        rows = barrier.rows(features, state)
        total = total + rows.coefficients @ velocity - rows.bounds
    depth = body.points(positions) @ NORMAL - obstacle.level
    vertices = [int(np.argmin(np.abs(depth - distance))) for distance in features.distance]
    step = 1e-5
    for m, vertex in enumerate(vertices):
        ends = [
            distance_later(sign * step, vertex, body, obstacle, positions, velocities)
            for sign in (-1.0, 1.0)
        ]
        rate = (ends[1] - ends[0]) / (2.0 * step)
        alpha = PiecewiseLinearClassK(*SLOPES)(features.distance[m] - OFFSET)
        assert total[m] == pytest.approx(rate + alpha, rel=1e-6, abs=1e-6)


@pytest.mark.parametrize("seed", range(4))
def test_rows_of_all_together_are_the_sum_of_the_shares(seed):
    """And so the whole constraint."""
    *_, velocities, features = setting(3, seed)
    state = state_of(velocities)
    shares = [barrier.rows(features, state) for barrier in barriers(3)]
    together = build.collision_barrier([3, 1, 2], [1, 2, 3], formulation(), band=BAND).rows(
        features, state
    )
    np.testing.assert_allclose(together.bounds, sum(rows.bounds for rows in shares), atol=1e-12)
    np.testing.assert_array_equal(
        together.coefficients, np.hstack([shares[i].coefficients for i in (2, 0, 1)])
    )


def test_distance_is_predicted_for_the_time_when_the_command_acts():
    body, obstacle, positions, velocities, features = setting(2, 3)
    now = barriers(2)[0].rows(features, state_of(velocities))
    delay = 0.02
    later = barriers(2)[0].rows(features, state_of(velocities, delay))
    moved = build.observe(0.0, positions + delay * velocities, body, obstacle.at(delay))
    differences = Differences(3, leader=0)
    differences.update(moved)
    there = differences.features(moved)
    exact = barriers(2)[0].rows(there, state_of(velocities))
    assert abs(now.bounds[0] - exact.bounds[0]) > 1e-3
    np.testing.assert_allclose(later.bounds[0], exact.bounds[0], atol=1e-9)


def test_a_formation_along_the_obstacle_is_not_held_back():
    body = build.random_object(np.random.default_rng(2), 3)
    positions = np.random.default_rng(3).normal(size=(3, 3))
    lowest = (body.points(positions) @ NORMAL).min()
    obstacle = build.HalfSpace(NORMAL, lowest - OFFSET)  # at the offset exactly
    observation = build.observe(0.0, positions, body, obstacle)
    differences = Differences(3, leader=0)
    differences.update(observation)
    along = np.cross(NORMAL, (1.0, 0.0, 0.0))
    state = state_of(np.tile(along, (3, 1)))
    for barrier in barriers(2):
        rows = barrier.rows(differences.features(observation), state)
        assert (rows.coefficients @ along >= rows.bounds - 1e-9).all()


def test_without_leader_velocity_and_shares_it_is_the_papers_row():
    _, _, _, velocities, features = setting(1, 1)
    still = Features(features.distance, features.normal, 0.0 * features.normal, features.gradients)
    barrier = barriers(1, leader_velocity=False, shares=False)[0]
    rows = barrier.rows(still, state_of(velocities))
    alpha = np.array([PiecewiseLinearClassK(*SLOPES)(d - OFFSET) for d in features.distance])
    np.testing.assert_array_equal(rows.coefficients, features.gradients[:, 1])
    np.testing.assert_allclose(rows.bounds, -alpha)


def test_the_velocity_of_obstacles_may_be_left_out():
    _, _, _, velocities, features = setting(2, 5)
    standing = Features(
        features.distance, features.normal, 0.0 * features.normal, features.gradients
    )
    state = state_of(velocities, 0.02)
    left_out = barriers(2, obstacle_velocity=False)[0].rows(features, state)
    np.testing.assert_array_equal(left_out.bounds, barriers(2)[0].rows(standing, state).bounds)
    assert abs(left_out.bounds - barriers(2)[0].rows(features, state).bounds).min() > 1e-3


def test_a_feature_that_nobody_moves_is_shared_equally():
    normal = np.array([[0.0, 0.0, 1.0]])
    gradients = np.zeros((1, 3, 3))
    gradients[:, 0] = normal
    features = Features(np.array([0.0]), normal, 0.0 * normal, gradients)
    leader = np.array([0.0, 0.0, -0.1])
    for barrier in barriers(2):
        rows = barrier.rows(features, state_of(np.array([leader, [0, 0, 0], [0, 0, 0]])))
        np.testing.assert_array_equal(rows.coefficients, 0.0)
        np.testing.assert_allclose(rows.bounds, 0.5 * (0.1 + 5.0 * OFFSET))


def one_feature(distances, leader=(0.0, 0.0, 0.0), parting=0.0):
    """Level features above ground that assistant 1 raises half as fast as it rises, and a state."""
    count = len(distances)
    normal = np.tile((0.0, 0.0, 1.0), (count, 1))
    gradients = 0.5 * np.repeat(normal[:, None], 2, axis=1)
    features = Features(np.array(distances), normal, 0.0 * normal, gradients, parting)
    return features, state_of(np.array([leader, [0.0, 0.0, 0.0]]))


def test_rows_keep_their_margins_above_the_offset():
    features, state = one_feature([OFFSET + 0.01], leader=(0.1, 0.0, 0.0))
    rows = barriers(1, margin=0.002, speed_margin=0.03)[0].rows(features, state)
    np.testing.assert_allclose(rows.bounds, -(0.01 - 0.002 - 0.003))


@pytest.mark.parametrize("parting, more", [(0.0, 0.0), (0.01, 0.003), (0.02, 0.006), (0.1, 0.006)])
def test_rows_keep_more_where_the_copies_part(parting, more):
    features, state = one_feature([OFFSET + 0.01], parting=parting)
    rows = barriers(1, margin=0.002, snap_margin=0.006)[0].rows(features, state)
    np.testing.assert_allclose(rows.bounds, -(0.01 - 0.002 - more))


def test_a_softer_row_asks_earlier():
    features, state = one_feature([OFFSET + 0.02])
    barrier = build.collision_barrier([1], [1], Formulation.full())
    rows = barrier.rows(features, state)
    assert rows.kinds == [0, 1]  # the limit, the wish
    np.testing.assert_allclose(rows.bounds, [-0.02, -0.008])
    np.testing.assert_array_equal(rows.coefficients[0], rows.coefficients[1])


def test_rows_come_and_go_without_a_step():
    """Towards the edge of the band it loosens steadily, until no velocity is beyond it."""
    band, nearest, bounds = 0.1, OFFSET - 0.08, []
    barrier = barriers(1, band=band)[0]
    for beyond in np.linspace(0.0, band, 201):
        bounds.append(barrier.rows(*one_feature([nearest, nearest + beyond])).bounds[1])
    assert bounds[0] == pytest.approx(5.0 * 0.08)
    assert bounds[-1] <= -0.5 * 0.15  # u_max against a gradient of one half
    steps = np.diff(bounds)
    assert (steps < 0.0).all() and np.abs(steps).max() < 0.01


def approached(disturbance_filter, told, cycles=100, **collision):
    """The velocity of an assistant under whose rope a ground rises at 0.02 m/s."""
    scenario = build.scenario(
        disturbance_filter=disturbance_filter, collision=CollisionSpec(offset=OFFSET, **collision)
    )
    controller = build.Alone(scenario)
    positions = np.array([agent.start for agent in scenario.agents])
    body = build.hanging_chain(2, 0.5)
    velocity = (0.0, 0.0, 0.02) if told else (0.0, 0.0, 0.0)
    ground = build.HalfSpace((0.0, 0.0, 1.0), 0.42)
    for cycle in range(cycles):
        risen = build.HalfSpace(ground.normal, ground.level + 0.02 * 0.01 * cycle, velocity)
        observation = build.observe(0.01 * cycle, positions, body, risen, cycle=cycle)
        decision = controller.update(observation)
    return decision.command


def test_an_obstacle_whose_velocity_nobody_tells_is_a_disturbance():
    unaware, observed, told = (
        approached(0.0, False)[2],
        approached(0.1, False)[2],
        approached(0.0, True)[2],
    )
    assert unaware < 0.5 * told
    assert observed == pytest.approx(told, rel=0.05)


def test_nothing_is_observed_of_what_is_told():
    assert approached(0.1, True) == pytest.approx(approached(0.0, True), abs=1e-9)


def test_a_velocity_that_the_rows_leave_out_is_a_disturbance():
    left_out = approached(0.1, True, obstacle_velocity=False)
    assert left_out == pytest.approx(approached(0.1, False), abs=1e-9) and left_out[2] > 0.0
