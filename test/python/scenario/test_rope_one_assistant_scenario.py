"""The scenario of a rope with one assistant is the one that it is meant to be."""

import math

import numpy as np
import pytest
import shapely

from deformable_manipulation.scenario import load_scenario, pair_limits


@pytest.fixture(scope="module")
def scenario():
    return load_scenario("rope_one_assistant")


@pytest.fixture(scope="module")
def ground(scenario):
    return shapely.Polygon(scenario.obstacles[0].points)


def test_rope(scenario):
    rope = scenario.object
    assert (rope.length, rope.radius, rope.density, rope.segments) == (2.25, 0.0035, 1792.89, 28)
    assert (rope.young_modulus, rope.torsion_modulus) == (3.0e7, 1.0e7)


def test_agents_hold_the_ends_at_equal_height(scenario):
    leader, assistant = scenario.agents
    assert (leader.role, leader.particle) == ("leader", 0)
    assert (assistant.role, assistant.particle) == ("assistant", 27)
    assert leader.start[2] == assistant.start[2]
    assert math.dist(leader.start, assistant.start) == pytest.approx(1.5)
    assert pair_limits(scenario, 0, 1).max_distance == pytest.approx(0.99 * 2.25 * 27 / 28)


def test_controller(scenario):
    controller = scenario.controller
    assert controller.collision.offset == 0.05
    assert controller.perturbation == (0.1, 0.1, 0.1)
    assert controller.max_velocity == 0.15
    assert (scenario.simulation.duration, scenario.cycles) == (160.0, 16000)


def test_ground(scenario, ground):
    (obstacle,) = scenario.obstacles
    assert (len(obstacle.points), obstacle.plane) == (86, "yz")
    assert ground.bounds[1] < -2.0  # deep enough that no rope sees the bottom as nearest


def test_leader_s_grip_stays_clear_of_the_ground(scenario, ground):
    start = np.array(scenario.agents[0].start)
    path = shapely.LineString(
        [(start + waypoint.position)[1:] for waypoint in scenario.leader.waypoints]
    )
    assert ground.distance(path) > 0.15


def test_leader_goes_slowly_enough_to_be_answered(scenario):
    waypoints = scenario.leader.waypoints
    speeds = [
        math.dist(a.position, b.position) / (b.time - a.time)
        for a, b in zip(waypoints, waypoints[1:])
    ]
    assert 0.0 < max(speeds) < 0.05  # mean between waypoints


def hanging_rope(start, end, length, count=200):
    """Catenary between two points of equal height [m]: the rope without its bending stiffness."""
    span = end[0] - start[0]
    low, high = 1e-3, 1e3
    for _ in range(200):  # length = 2 a sinh(span / 2 a) falls with a
        a = math.sqrt(low * high)
        low, high = (a, high) if 2 * a * math.sinh(min(span / (2 * a), 700)) > length else (low, a)
    y = np.linspace(-span / 2, span / 2, count)
    z = a * (np.cosh(y / a) - math.cosh(span / (2 * a)))
    return shapely.LineString(np.column_stack([start[0] + span / 2 + y, start[1] + z]))


def test_rope_is_far_from_the_ground_at_first_and_last_and_in_it_between(scenario, ground):
    leader, assistant = scenario.agents
    free_length = 2.25 * 27 / 28

    def rope(waypoint):
        grips = [
            (agent.start[1] + waypoint.position[1], agent.start[2] + waypoint.position[2])
            for agent in (leader, assistant)
        ]
        return hanging_rope(*grips, free_length)

    waypoints = scenario.leader.waypoints
    far = [w for w in waypoints if w.time <= 30.0 or w.time >= 130.0]
    assert far[0].time == 0.0 and {30.0, 130.0} <= {w.time for w in far}
    assert min(ground.distance(rope(w)) for w in far) > 0.3
    assert any(ground.intersects(rope(w)) for w in waypoints if 30.0 < w.time < 130.0)
