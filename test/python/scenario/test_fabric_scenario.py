"""The scenario of a fabric with three assistants is the one that it is meant to be."""

import math

import numpy as np
import pytest

from deformable_manipulation.distance.factory import make_minimum_distance
from deformable_manipulation.scenario import load_scenario, pair_limits
from deformable_manipulation.simulation.factory import make_simulation


@pytest.fixture(scope="module")
def scenario():
    return load_scenario("fabric_three_assistants")


def test_fabric(scenario):
    assert (scenario.object.particles, len(scenario.object.triangles)) == (225, 392)
    assert scenario.object.density == 1.0
    corners = [scenario.object.particle_position(index) for index in (0, 14, 210, 224)]
    assert math.dist(corners[0], corners[1]) == math.dist(corners[0], corners[2]) == 2.0
    assert math.dist(corners[0], corners[3]) == pytest.approx(2.0 * math.sqrt(2.0))


def test_agents_hold_the_corners(scenario):
    held = {agent.name: agent.particle for agent in scenario.agents}
    assert held == {"leader": 0, "assistant_1": 14, "assistant_2": 210, "assistant_3": 224}
    assert scenario.agents[0].role == "leader"


def test_limits(scenario):
    assert scenario.controller.collision.offset == 0.1
    assert (scenario.simulation.duration, scenario.simulation.substeps) == (900.0, 10)
    slack = pair_limits(scenario, 0, 1).max_distance - math.dist(
        scenario.agents[0].start, scenario.agents[1].start
    )
    assert 0.0 < slack < 0.1  # tight


def test_the_cube(scenario):
    (cube,) = scenario.obstacles
    assert cube.mesh.endswith("config/obstacles/cube.obj") and cube.scale == (1.0, 1.0, 1.0)


def test_the_fabric_is_far_at_first_and_last_and_would_be_in_the_cube_between(scenario):
    """In formation, as without the safety filter, the settled fabric moves as the leader does."""
    settled = make_simulation(scenario).points()[0]
    waypoints = scenario.leader.waypoints
    copies = np.stack([settled + waypoint.position for waypoint in waypoints])
    distances = make_minimum_distance(scenario).compute(copies).minimum
    assert min(distances[0], distances[-1]) > 0.4
    assert distances.min() < -0.05
