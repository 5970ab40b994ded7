"""The scenarios of ropes and rods are the ones that they are meant to be."""

import math

import numpy as np
import pytest
import shapely

from deformable_manipulation.scenario import load_scenario, pair_limits
from deformable_manipulation.simulation.factory import make_simulation

ROPE, STIFF_ROD = "rope_one_assistant", "stiff_rod_one_assistant"
TWO_ASSISTANTS = "rope_two_assistants"


@pytest.fixture(scope="module", params=(ROPE, STIFF_ROD, TWO_ASSISTANTS))
def scenario(request):
    return load_scenario(request.param)


@pytest.fixture(scope="module")
def ground(scenario):
    return shapely.Polygon(scenario.obstacles[0].points)


@pytest.mark.parametrize(
    "name, length, segments, moduli",
    [
        (ROPE, 2.25, 28, (3.0e7, 1.0e7)),
        (STIFF_ROD, 2.25, 28, (3.0e10, 1.0e10)),
        (TWO_ASSISTANTS, 3.25, 45, (3.0e7, 1.0e7)),
    ],
)
def test_object(name, length, segments, moduli):
    rod = load_scenario(name).object
    assert (rod.young_modulus, rod.torsion_modulus) == moduli
    assert (rod.length, rod.radius, rod.density, rod.segments) == (
        length,
        0.0035,
        1792.89,
        segments,
    )


@pytest.mark.parametrize(
    "name, particles, hold, apart",
    [
        (ROPE, (0, 27), "clamped", 1.5),
        (STIFF_ROD, (0, 27), "pinned", 1.9),
        (TWO_ASSISTANTS, (0, 22, 44), "clamped", 1.15),
    ],
)
def test_agents(name, particles, hold, apart):
    """The leader at one end, neighbours equally far apart at equal height."""
    agents = load_scenario(name).agents
    assert tuple(agent.particle for agent in agents) == particles
    assert [agent.role for agent in agents] == ["leader"] + ["assistant"] * (len(agents) - 1)
    for agent, following in zip(agents, agents[1:]):
        assert agent.hold == following.hold == hold
        assert math.dist(agent.start, following.start) == pytest.approx(apart)
        assert agent.start[2] == following.start[2]


def test_agents_may_part_as_far_as_the_rod_between_them_reaches(scenario):
    rod, agents = scenario.object, scenario.agents
    for i, agent in enumerate(agents):
        for j in range(i):
            segments = agent.particle - agents[j].particle
            longest = 0.99 * rod.length * segments / rod.segments
            assert pair_limits(scenario, i, j).max_distance == pytest.approx(longest)


def test_controller(scenario):
    controller = scenario.controller
    assert controller.collision.offset == 0.05
    assert controller.perturbation == (0.1, 0.1, 0.1)
    assert controller.max_velocity == 0.15
    assert (scenario.simulation.duration, scenario.cycles) == (160.0, 16000)


def test_ground(scenario, ground):
    (obstacle,) = scenario.obstacles
    assert (len(obstacle.points), obstacle.plane) == (86, "yz")
    assert ground.bounds[1] < -2.0  # deep enough that no rod sees the bottom as nearest


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


def test_rod_is_far_from_the_ground_at_first_and_last_and_would_be_in_it_between(scenario, ground):
    """In formation, as without the safety filter, the settled rod moves as the leader does."""
    settled = make_simulation(scenario).points()[0, :, 1:]

    def rod(waypoint):
        return shapely.LineString(settled + waypoint.position[1:])

    waypoints = scenario.leader.waypoints
    far = [w for w in waypoints if w.time <= 30.0 or w.time >= 130.0]
    assert far[0].time == 0.0 and {30.0, 130.0} <= {w.time for w in far}
    assert min(ground.distance(rod(w)) for w in far) > 0.3
    assert any(ground.intersects(rod(w)) for w in waypoints if 30.0 < w.time < 130.0)
