"""The controllers' gradients of a carried fabric against the derivative of its equilibrium."""

import json

import numpy as np
import pytest

from deformable_manipulation.closed_loop import ClosedLoop, make_minimum_distance
from deformable_manipulation.scenario import load_scenario
from deformable_manipulation.validation.references.mesh_equilibrium import MeshEnergy

NAME = "fabric_three_assistants"
WAYPOINTS = [
    {"time": 0.0, "position": [0.0, 0.0, 0.0]},
    {"time": 20.0, "position": [0.0, 1.2, -0.45]},
]
NEAR = 0.16  # m
EVERY = 100  # cycles
TOLERANCE = 0.03  # of gradients of up to 1


@pytest.fixture(scope="module")
def scenario():
    return load_scenario(
        NAME, [("leader.waypoints", json.dumps(WAYPOINTS)), ("simulation.duration", "20")]
    )


@pytest.fixture(scope="module")
def near_states(scenario):
    """Records of cycles in which the fabric moves close over the cube."""
    loop = ClosedLoop(scenario)
    records = (loop.step() for _ in range(scenario.cycles))
    return [record for record in records if record.cycle % EVERY == 0 and record.distance < NEAR]


def exact_gradients(scenario, record):
    """Change (A, 3) of the distance with the agents' held points where the fabric is at rest."""
    fabric = scenario.object
    energy = MeshEnergy(
        np.array(fabric.vertices),
        np.array(fabric.triangles),
        fabric.density,
        fabric.stretching_compliance,
        fabric.bending_compliance,
    )
    held = [agent.particle for agent in scenario.agents]
    rest = energy.minimised(record.points, held)
    nearest = make_minimum_distance(scenario).compute(rest[None])
    corners = energy.response(rest, held)[:, nearest.vertices[0]]
    return np.einsum("akij,k,i->aj", corners, nearest.weights[0], nearest.normal[0])


def test_gradients_in_motion_are_those_of_the_equilibrium(scenario, near_states):
    assert len(near_states) >= 5
    names = [agent.name for agent in scenario.agents]
    for record in near_states:
        exact = exact_gradients(scenario, record)
        for index in scenario.assistants:
            gradient = record.decisions[names[index]].jacobian
            assert np.linalg.norm(gradient - exact[index]) < TOLERANCE, (record.time, names[index])
