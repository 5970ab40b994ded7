"""Random variations: what they change, what they keep, and that they repeat."""

import dataclasses

import numpy as np
import pytest

from deformable_manipulation.campaign.leader_paths import DIVES, NoPath, random_path
from deformable_manipulation.campaign.reasons import Reasons
from deformable_manipulation.campaign.terrain import random_obstacle, random_obstacles
from deformable_manipulation.campaign.variation import NoVariation, Ranges, vary
from deformable_manipulation.distance.factory import make_minimum_distance
from deformable_manipulation.distance.minimum_distance import MinimumDistance
from deformable_manipulation.motion.leader import LeaderPath
from deformable_manipulation.obstacles.spec import placed
from deformable_manipulation.reading.errors import Problem, ScenarioError
from deformable_manipulation.scenario import load_scenario
from deformable_manipulation.simulation.factory import make_simulation

RANGES = Ranges(speed=0.15, duration=60.0)


@pytest.fixture(scope="module", params=("rope_one_assistant", "rope_two_assistants"))
def scenario(request):
    return load_scenario(request.param)


@pytest.fixture(scope="module")
def varied(scenario):
    return [vary(scenario, RANGES, 7, index) for index in range(5)]


def test_the_most_frequent_reasons_are_told_with_their_counts():
    reasons = Reasons()
    for number in range(60):
        reasons.add(f"it is {0.1 * number:g} m long")
    for _ in range(30):
        reasons.add(
            ScenarioError([Problem("agents.a.start", "is too far", "3"), Problem("b", "c")])
        )
    for text in ("once", "twice", "twice", "never"):
        reasons.add(text)
    assert str(reasons) == (
        "60 times: it is 0 m long; 30 times: agents.a.start: 3 \u2014 is too far; b: c; "
        "2 times: twice; 2 times: something else"
    )


def test_the_same_number_gives_the_same_variation(scenario, varied):
    assert vary(scenario, RANGES, 7, 3) == varied[3]


def test_other_numbers_and_seeds_give_others(scenario, varied):
    paths = {each.leader for each in varied} | {vary(scenario, RANGES, 8, 3).leader}
    assert len(paths) == 6


def test_the_leader_goes_no_faster_than_asked_and_rests_at_both_ends(varied):
    for each in varied:
        path = LeaderPath(each.leader.waypoints)
        velocity = path.velocity(np.linspace(0.0, RANGES.duration, 5000))
        assert 0.5 * RANGES.speed < np.abs(velocity).max() <= 1.01 * RANGES.speed
        assert each.leader.waypoints[-1].time <= RANGES.duration - 10.0
        assert each.leader.waypoints[-1].position == (0.0, 0.0, 0.0)


def test_the_leader_s_grip_stays_clear(varied):
    for each in varied:
        start = np.array(each.agents[0].start)
        times = np.linspace(0.0, RANGES.duration, 2000)
        points = start + LeaderPath(each.leader.waypoints).position(times)
        compute = make_minimum_distance(each).compute
        copies = np.repeat(points[:, None], each.object.segments + 1, axis=1)
        assert compute(copies).minimum.min() > RANGES.clearance - 0.01


def test_the_object_starts_clear_of_the_obstacles(varied):
    for each in varied:
        settled = make_simulation(each).points()[:1]
        lowest = make_minimum_distance(each).compute(settled).minimum[0]
        assert lowest > each.controller.collision.offset


def test_material_terrain_and_starts_are_others(scenario, varied):
    for each in varied:
        factor = each.object.young_modulus / scenario.object.young_modulus
        assert 1.0 / RANGES.material <= factor <= RANGES.material and factor != 1.0
        assert each.obstacles != scenario.obstacles
        assert each.agents[0].start == scenario.agents[0].start
        assert each.agents[1].start != scenario.agents[1].start


def test_imperfect_knowledge_is_drawn_and_changes_nothing_else(scenario, varied):
    ranges = dataclasses.replace(RANGES, imperfect=True)
    for index, perfect in enumerate(varied):
        imperfect = vary(scenario, ranges, 7, index)
        known = imperfect.knowledge
        assert 0.0 < known.pose_noise <= 0.002 and 0.0 < known.pose_delay <= 0.05
        assert 0.5 <= known.stiffness_factor <= 2.0 and 0.5 <= known.density_factor <= 2.0
        assert 0.0 < known.dropped_cycles <= 0.2
        assert dataclasses.replace(imperfect, knowledge=perfect.knowledge) == perfect


def test_what_is_not_to_change_stays(scenario):
    ranges = dataclasses.replace(RANGES, material=1.0, terrain=False)
    varied = vary(scenario, ranges, 0, 0)
    assert varied.object == scenario.object and varied.obstacles == scenario.obstacles
    assert varied.controller == scenario.controller


def test_a_clearance_that_no_path_keeps_is_an_error(scenario):
    with pytest.raises(NoVariation, match="keeps the leader 9 m clear"):
        vary(scenario, dataclasses.replace(RANGES, clearance=9.0), 0, 0)


def test_a_time_that_is_too_short_is_an_error(scenario):
    with pytest.raises(NoVariation, match="10 s are too short"):
        vary(scenario, dataclasses.replace(RANGES, duration=10.0), 0, 0)


def test_a_path_leaves_its_box_never():
    low, high = np.array([-0.1, 0.0, -1.0]), np.array([0.1, 2.0, 0.0])
    for seed in range(20):
        random = np.random.default_rng(seed)
        waypoints = random_path(
            random, low, high, 0.1, 90.0, lambda points: np.ones(len(points)), 0.5
        )
        points = LeaderPath(waypoints).position(np.linspace(0.0, 90.0, 500))
        assert (points >= low - 1e-12).all() and (points <= high + 1e-12).all()


def test_no_path_where_everything_is_near():
    with pytest.raises(NoPath):
        random_path(
            np.random.default_rng(0),
            np.zeros(3),
            np.ones(3),
            0.1,
            60.0,
            lambda points: np.zeros(len(points)),
            0.1,
        )


def test_dives_go_straight_down_next_to_obstacles(scenario):
    ranges = dataclasses.replace(RANGES, speed=0.3, path=DIVES)
    for index in range(5):
        varied = vary(scenario, ranges, 7, index)
        path = LeaderPath(varied.leader.waypoints)
        times = np.linspace(0.0, ranges.duration, 6000)
        velocity = path.velocity(times)
        assert np.abs(velocity).max() <= 1.01 * ranges.speed
        down = velocity[:, 2] < -0.8 * ranges.speed
        straight = np.abs(velocity[:, :2]).max(axis=1) < 1e-6
        assert (down & straight).any()
        assert varied.leader.waypoints[-1].time <= ranges.duration - 10.0


def test_paths_from_place_to_place_are_those_of_before():
    """Campaigns can be compared with older ones: the same seed gives the same runs."""
    waypoints = vary(load_scenario("rope_one_assistant"), Ranges(), 1, 0).leader.waypoints
    assert len(waypoints) == 7
    assert waypoints[2].time == pytest.approx(37.93272183)
    np.testing.assert_allclose(waypoints[2].position, (-0.05088955, 1.16805305, -0.92482283))


def test_a_map_moves_with_what_it_is_of():
    """Places of the machine are as deep in the map, wherever both are put."""
    given = load_scenario("fabric_over_octomap").obstacles
    moved = random_obstacles(given, np.random.default_rng(3))
    assert all(each.translation != before.translation for each, before in zip(moved, given))
    for before, after in zip(given[1:], moved[1:]):
        depths = [
            MinimumDistance([the_map], 0.0).compute(surface_points(part)).minimum
            for the_map, part in ((given[0], before), (moved[0], after))
        ]
        np.testing.assert_allclose(*depths, atol=1e-6)
        assert depths[0].max() < 1e-6


def surface_points(obstacle):
    """As copies (N, 2, 3) [m] of a line that is nowhere else."""
    points = placed(obstacle, obstacle.drawing().triangles).reshape(-1, 3)
    return np.repeat(points[:, None], 2, axis=1)


def test_without_a_map_each_obstacle_is_changed_by_itself():
    given = load_scenario("rope_over_depth_camera")
    ground, seen = random_obstacles(given.obstacles, np.random.default_rng(3))
    assert ground == random_obstacle(given.obstacles[0], np.random.default_rng(3))
    assert seen == given.obstacles[1]
