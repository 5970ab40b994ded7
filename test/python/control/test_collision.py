import control_builders as build
import numpy as np
import pytest

from deformable_manipulation.control.barriers import Situation
from deformable_manipulation.control.class_k import PiecewiseLinearClassK
from deformable_manipulation.control.collision import CollisionBarrier
from deformable_manipulation.control.differences import Differences
from deformable_manipulation.control.features import Features

SLOPES, OFFSET = (1.0, 5.0), 0.05
NORMAL = np.array([2.0, -1.0, 2.0]) / 3.0


def situation(velocities, leader_velocity, delay=0.0):
    return Situation(
        positions=np.zeros_like(velocities),
        velocities=velocities,
        leader_velocity=leader_velocity,
        delay=delay,
    )


def setting(assistants, seed):
    """A linear object, a moving obstacle, held points, their velocities, and the features."""
    generator = np.random.default_rng(seed)
    body = build.random_object(generator, assistants + 1)
    obstacle = build.HalfSpace(NORMAL, -1.0, generator.normal(size=3))
    positions, velocities = generator.normal(size=(2, assistants + 1, 3))
    observation = build.observe(0.0, positions, body, obstacle)
    differences = Differences(assistants + 1, leader=0)
    differences.update(observation)
    return body, obstacle, positions, velocities, differences.features(observation.distances)


def barriers(assistants, **settings):
    everybody = tuple(range(1, assistants + 1))
    return [CollisionBarrier(i, everybody, OFFSET, SLOPES, **settings) for i in everybody]


def distance_later(seconds, vertex, body, obstacle, positions, velocities):
    moved = body.points(positions + seconds * velocities)[vertex]
    return moved @ NORMAL - obstacle.at(seconds).level


@pytest.mark.parametrize("assistants", [1, 2, 3])
@pytest.mark.parametrize("seed", range(4))
def test_rows_sum_to_the_whole_constraint(assistants, seed):
    """Sum of g . u - bound over the assistants is dh/dt + alpha(h), h moved in time."""
    body, obstacle, positions, velocities, features = setting(assistants, seed)
    scene = situation(velocities, velocities[0])
    total = 0.0
    for barrier, velocity in zip(barriers(assistants), velocities[1:]):
        rows = barrier.rows(features, scene)
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
        alpha = PiecewiseLinearClassK(SLOPES)(features.distance[m] - OFFSET)
        assert total[m] == pytest.approx(rate + alpha, rel=1e-6, abs=1e-6)


def test_distance_is_predicted_for_the_time_when_the_command_acts():
    body, obstacle, positions, velocities, features = setting(2, 3)
    now = barriers(2)[0].rows(features, situation(velocities, velocities[0]))
    delay = 0.02
    later = barriers(2)[0].rows(features, situation(velocities, velocities[0], delay))
    moved = build.observe(0.0, positions + delay * velocities, body, obstacle.at(delay))
    differences = Differences(3, leader=0)
    differences.update(moved)
    there = differences.features(moved.distances)
    exact = barriers(2)[0].rows(there, situation(velocities, velocities[0]))
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
    scene = situation(np.tile(along, (3, 1)), along)
    for barrier in barriers(2):
        rows = barrier.rows(differences.features(observation.distances), scene)
        assert (rows.coefficients @ along >= rows.bounds - 1e-9).all()


def test_without_feedforward_it_is_the_papers_row():
    _, _, _, velocities, features = setting(1, 1)
    still = Features(features.distance, features.normal, 0.0 * features.normal, features.gradients)
    barrier = barriers(1, feedforward=False)[0]
    rows = barrier.rows(still, situation(velocities, velocities[0]))
    alpha = PiecewiseLinearClassK(SLOPES)(features.distance - OFFSET)
    np.testing.assert_array_equal(rows.coefficients, features.gradients[:, 1])
    np.testing.assert_allclose(rows.bounds, -alpha)


def test_a_feature_that_nobody_moves_is_shared_equally():
    normal = np.array([[0.0, 0.0, 1.0]])
    gradients = np.zeros((1, 3, 3))
    gradients[:, 0] = normal
    features = Features(np.array([0.0]), normal, 0.0 * normal, gradients)
    leader = np.array([0.0, 0.0, -0.1])
    for barrier in barriers(2):
        rows = barrier.rows(features, situation(np.zeros((3, 3)), leader))
        np.testing.assert_array_equal(rows.coefficients, 0.0)
        np.testing.assert_allclose(rows.bounds, 0.5 * (0.1 + 5.0 * OFFSET))
