import dataclasses

import control_builders as build
import numpy as np
import pytest
from mesh_reference import changed

from deformable_manipulation._control import Differences, response_features
from deformable_manipulation.control.status import Status

AGENTS = 3  # the first is the leader


@pytest.fixture
def seen():
    """A body whose points move linearly with its held points, and an observation of it."""
    generator = np.random.default_rng(7)
    body = build.random_object(generator, AGENTS)
    positions = generator.normal(size=(AGENTS, 3))
    obstacle = build.HalfSpace(np.array([2.0, -1.0, 2.0]) / 3.0, -1.0)
    return body, build.observe(0.0, positions, body, obstacle, build.axis_copies(AGENTS))


def exact_features(body, observation, **settings):
    known = dataclasses.replace(observation, sensitivities=body.sensitivities)
    return response_features(known, AGENTS, leader=0, **settings)


def test_agrees_with_the_copies_of_a_linear_object(seen):
    body, observation = seen
    differences = Differences(AGENTS, leader=0)
    differences.update(observation)
    expected = differences.features(observation)
    features = exact_features(body, observation)
    np.testing.assert_allclose(features.gradients, expected.gradients, atol=1e-11)
    np.testing.assert_array_equal(features.distance, expected.distance)


def test_gradients_sum_to_the_normal(seen):
    body, observation = seen
    features = exact_features(body, observation)
    np.testing.assert_allclose(features.gradients.sum(axis=1), features.normal, atol=1e-12)


def test_nearest_only_is_the_minimum(seen):
    body, observation = seen
    features = exact_features(body, observation, nearest_only=True)
    assert features.distance == observation.distances.minimum[0]


def controller(**settings):
    return build.Alone(build.scenario(2, **settings))


def without_copies(observation):
    """The same state without copies: only the exact response tells how the object moves."""
    first = observation.distances.of_copy(0)
    rows = {
        name: getattr(observation.distances, name)[first]
        for name in (
            "distance",
            "obstacle",
            "object_point",
            "obstacle_point",
            "normal",
            "vertices",
            "weights",
            "obstacle_velocity",
            "identity",
        )
    }
    distances = changed(
        observation.distances,
        minimum=observation.distances.minimum[:1],
        offsets=observation.distances.offsets[:2],
        **rows,
    )
    return dataclasses.replace(
        observation,
        points=observation.points[:1],
        displaced_agents=observation.displaced_agents[:1],
        displacements=observation.displacements[:1],
        ready=observation.ready[:1],
        distances=distances,
    )


def test_the_controller_takes_the_exact_response_where_it_is_wanted_and_known(seen):
    body, observation = seen
    known = dataclasses.replace(observation, sensitivities=body.sensitivities)
    copies = controller(jacobian="perturbed_copies").update(known)
    exact = controller(jacobian="equilibrium").update(known)
    assert exact.exact_jacobian and not copies.exact_jacobian
    np.testing.assert_allclose(exact.jacobian, copies.jacobian, atol=1e-11)
    np.testing.assert_allclose(exact.command, copies.command, atol=1e-9)


def test_the_copies_take_over_where_the_exact_response_is_not_known(seen):
    _, observation = seen
    decision = controller(jacobian="equilibrium").update(observation)
    assert not decision.exact_jacobian
    np.testing.assert_array_equal(decision.command, controller().update(observation).command)


def test_the_exact_response_needs_no_copies(seen):
    body, observation = seen
    alone = without_copies(observation)
    known = dataclasses.replace(alone, sensitivities=body.sensitivities)
    assert controller(jacobian="equilibrium").update(known).status != Status.WAITING
    assert controller(jacobian="equilibrium").update(alone).status == Status.WAITING


@pytest.mark.parametrize(
    "wrong, text",
    [
        (lambda right: right[:, :-1], "sensitivities of the state has shape"),
        (lambda right: right * np.nan, "sensitivities of the state holds a number"),
    ],
)
def test_a_faulty_response_is_refused(seen, wrong, text):
    body, observation = seen
    faulty = dataclasses.replace(observation, sensitivities=wrong(body.sensitivities))
    decision = controller(jacobian="equilibrium").update(faulty)
    assert decision.status == Status.WAITING
    assert text in decision.text
