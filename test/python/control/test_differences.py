import dataclasses

import control_builders as build
import numpy as np
import pytest
from mesh_reference import changed

from deformable_manipulation._control import Differences

AGENTS = 3  # the first is the leader


@pytest.fixture
def setting():
    generator = np.random.default_rng(5)
    normal = np.array([2.0, -1.0, 2.0]) / 3.0
    return (
        build.random_object(generator, AGENTS),
        build.HalfSpace(normal, -1.0),
        generator.normal(size=(AGENTS, 3)),
    )


def exact_gradients(body, distances):
    """d distance / d held point (M, A, 3) of the features of copy 0."""
    chosen = distances.of_copy(0)
    rates = body.sensitivities[:, distances.vertices[chosen][:, 0]]
    return np.einsum("mi,amij->maj", distances.normal[chosen], rates)


def taken_in(observation):
    differences = Differences(AGENTS, leader=0)
    differences.update(observation)
    return differences


OBLIQUE = 0.1 * np.array([[1.0, 0.2, 0.0], [0.0, 1.0, -0.3], [0.4, 0.0, -1.0]])
BOTH_SIDES = np.concatenate((0.05 * np.eye(3), -0.05 * np.eye(3)))


@pytest.mark.parametrize("directions", [0.1 * np.eye(3), -0.1 * np.eye(3), OBLIQUE, BOTH_SIDES])
def test_gradients_of_all_agents(setting, directions):
    body, obstacle, positions = setting
    displaced = np.repeat([-1, 1, 2], [1, len(directions), len(directions)])
    displacements = np.concatenate((np.zeros((1, 3)), directions, directions))
    observation = build.observe(0.0, positions, body, obstacle, (displaced, displacements))
    features = taken_in(observation).features(observation)
    exact = exact_gradients(body, observation.distances)
    assert len(features.distance) >= 1
    np.testing.assert_allclose(features.gradients, exact, atol=1e-11)


def test_a_feature_between_two_points_takes_its_material_point(setting):
    body, obstacle, positions = setting
    observation = build.observe(0.0, positions, body, obstacle)
    distances = changed(
        observation.distances,
        vertices=np.tile((1, 4, 0), (len(observation.distances.distance), 1)),
        weights=np.tile((0.25, 0.75, 0.0), (len(observation.distances.distance), 1)),
    )
    features = taken_in(observation).features(dataclasses.replace(observation, distances=distances))
    rate = 0.25 * body.sensitivities[:, 1] + 0.75 * body.sensitivities[:, 4]
    np.testing.assert_allclose(features.gradients[0], np.einsum("i,aij->aj", obstacle.normal, rate))


def test_copies_that_follow_do_not_part(setting):
    body, obstacle, positions = setting
    observation = build.observe(0.0, positions, body, obstacle, build.axis_copies(AGENTS))
    np.testing.assert_allclose(taken_in(observation).features(observation).parting, 0.0, atol=1e-12)


@pytest.mark.parametrize("snapped", [[5], [0]])
def test_a_copy_that_has_snapped_parts_from_the_others(setting, snapped):
    """A copy has the new shape already, or the object has and all copies are left behind."""
    body, obstacle, positions = setting
    directions = BOTH_SIDES
    displaced = np.repeat([-1, 1, 2], [1, len(directions), len(directions)])
    displacements = np.concatenate((np.zeros((1, 3)), directions, directions))
    observation = build.observe(0.0, positions, body, obstacle, (displaced, displacements))
    snap = 0.02
    points = observation.points.copy()
    points[snapped] -= snap * obstacle.normal
    moved = dataclasses.replace(observation, points=points)
    # One side of a pair: half of it counts as the slope. All of them: it is left over in full.
    left_over = {5: 0.5 * snap, 0: snap}[snapped[0]]
    parting = taken_in(moved).features(moved).parting
    np.testing.assert_allclose(parting, left_over, rtol=1e-6)


def test_minimum_agrees_where_the_nearest_feature_stays(setting):
    body, obstacle, positions = setting
    copies = build.axis_copies(AGENTS, size=1e-4)
    observation = build.observe(0.0, positions, body, obstacle, copies)
    minimum = taken_in(observation).minimum(observation)
    exact = exact_gradients(body, observation.distances)[:1]
    np.testing.assert_allclose(minimum.gradients, exact, atol=1e-9)
    np.testing.assert_array_equal(minimum.distance, observation.distances.distance[:1])


def test_copies_that_are_not_ready_hold_their_column(setting):
    body, obstacle, positions = setting
    differences = Differences(AGENTS, leader=0)
    first = build.observe(0.0, positions, body, obstacle)
    differences.update(first)
    other = build.random_object(np.random.default_rng(6), AGENTS)
    ready = np.ones(7, dtype=bool)
    ready[2] = False  # agent 1 along y
    second = build.observe(0.01, positions, other, obstacle, ready=ready)
    differences.update(second)
    gradients = differences.features(second).gradients
    new, held = exact_gradients(other, second.distances), exact_gradients(body, second.distances)
    np.testing.assert_allclose(gradients[:, 1, [0, 2]], new[:, 1, [0, 2]], atol=1e-11)
    np.testing.assert_allclose(gradients[:, 1, 1], held[:, 1, 1], atol=1e-11)
    np.testing.assert_allclose(gradients[:, 2], new[:, 2], atol=1e-11)


def test_is_known_once_all_copies_were_ready(setting):
    body, obstacle, positions = setting
    differences = Differences(AGENTS, leader=0)
    ready = np.array([True, True, False, True, True, True, True])
    differences.update(build.observe(0.0, positions, body, obstacle, ready=ready))
    assert not differences.known(1) and differences.known(2)
    differences.update(build.observe(0.01, positions, body, obstacle))
    assert differences.known(1)
    differences.update(build.observe(0.02, positions, body, obstacle, ready=ready))
    assert differences.known(1)
    differences.reset()
    assert not differences.known(1)


def test_an_assistant_without_copies_counts_as_moving_with_the_leader(setting):
    body, obstacle, positions = setting
    displaced, displacements = build.axis_copies(AGENTS)
    only_own = displaced != 2
    copies = displaced[only_own], displacements[only_own]
    observation = build.observe(0.0, positions, body, obstacle, copies)
    gradients = taken_in(observation).features(observation).gradients
    exact = exact_gradients(body, observation.distances)
    np.testing.assert_allclose(gradients[:, 1], exact[:, 1], atol=1e-11)
    np.testing.assert_array_equal(gradients[:, 2], 0.0)
    np.testing.assert_allclose(gradients[:, 0], exact[:, 0] + exact[:, 2], atol=1e-11)


def test_a_copy_that_is_hardly_displaced_changes_nothing(setting):
    body, obstacle, positions = setting
    displaced, displacements = build.axis_copies(AGENTS)
    observation = build.observe(0.0, positions, body, obstacle, (displaced, 1e-9 * displacements))
    differences = taken_in(observation)
    gradients = differences.features(observation).gradients
    assert not differences.known(1)
    np.testing.assert_array_equal(gradients[:, 1:], 0.0)


def test_no_obstacle_gives_no_feature(setting):
    body, _, positions = setting
    observation = build.observe(0.0, positions, body, None)
    differences = taken_in(observation)
    assert differences.features(observation).gradients.shape == (0, AGENTS, 3)
    assert differences.minimum(observation).gradients.shape == (0, AGENTS, 3)
