"""Obstacles over the horizon: where their paths lead."""

import dataclasses

import numpy as np
import pytest

from deformable_manipulation.control.forecast import Forecast, sampled
from deformable_manipulation.control.status import Status
from deformable_manipulation.control.team import TeamController
from deformable_manipulation.motion.obstacle_motion import ObstaclePath
from deformable_manipulation.running.closed_loop import ClosedLoop
from deformable_manipulation.scenario import load_scenario

AHEAD = ("controller.horizon.length", "3")


def block(*overrides):
    (obstacle,) = load_scenario("rope_moving_obstacle", overrides).obstacles
    return obstacle


def test_samples_tell_the_path():
    begin, step, poses = sampled(block())
    path = ObstaclePath(block())
    for time in np.random.default_rng(1).uniform(0.0, 40.0, 100):
        place = np.clip((time - begin) / step, 0.0, len(poses) - 1.0)
        between = [np.interp(place, np.arange(len(poses)), column) for column in poses.T]
        pose = path.at(time)
        np.testing.assert_allclose(between, pose.translation + pose.rotation, atol=2e-5)


def test_an_obstacle_with_one_waypoint_stands_there():
    waypoints = "[{time: 3.0, position: [0.0, 0.0, 0.1]}]"
    _, step, poses = sampled(block(("obstacles.0.motion.waypoints", waypoints)))
    assert step > 0.0
    np.testing.assert_allclose(poses[:, :3], [[0.0, 1.1, 0.3]])


@pytest.mark.parametrize("name, moving", [("rope_moving_obstacle", 1), ("rope_one_assistant", 0)])
def test_obstacles_on_paths_are_told_apart(name, moving):
    assert len(Forecast(load_scenario(name)).moving()) == moving


MEASURED = ("obstacles.0.motion", "{topic: block}")


def test_what_is_measured_is_told_by_its_number():
    forecast = Forecast(load_scenario("rope_moving_obstacle", [MEASURED]))
    assert not forecast.moving() and len(forecast.measured()) == 1 and not forecast.knows_all


def commands_behind(observations, *overrides):
    """What a controller that knows no path commands."""
    scenario = load_scenario("rope_moving_obstacle", [MEASURED, *overrides])
    team = TeamController(scenario, ["assistant_1"])
    return np.array([team.update(each)["assistant_1"].command for each in observations])


def test_a_measured_obstacle_is_expected_to_go_on():
    """The block rises; the same poses without a path make who looks ahead rise sooner."""
    loop = ClosedLoop(load_scenario("rope_moving_obstacle", [("controller.horizon.length", "0")]))
    observations = []
    for _ in range(480):
        observed = loop._observer.observe()
        observations.append(dataclasses.replace(observed, points=observed.points.copy()))
        loop.step()
    assert observations[0].obstacles.shape == (1, 7)
    ahead = commands_behind(observations, AHEAD)
    present = commands_behind(observations, ("controller.horizon.length", "0"))
    assert ahead[450, 2] > 1.25 * present[450, 2] > 0.01


def run(seconds, *overrides):
    scenario = load_scenario("rope_moving_obstacle", overrides)
    loop = ClosedLoop(scenario)
    return [loop.step() for _ in range(round(seconds * scenario.controller.rate))]


def test_an_assistant_gives_way_before_the_obstacle_starts():
    """It begins to rise after 3 s; who looks at the present alone does not know before."""
    ahead, present = run(3.0, AHEAD), run(3.0, ("controller.horizon.length", "0"))
    commands = [
        max(np.abs(each.decisions["assistant_1"].command).max() for each in records)
        for records in (ahead, present)
    ]
    assert commands[0] > 0.003 and commands[1] < 1e-9


def test_no_program_is_relaxed_where_the_obstacle_comes_to_rest():
    """At its present velocity it would go on rising, and nobody could keep off it for 3 s."""
    records = run(8.0, AHEAD)
    assert all(each.decisions["assistant_1"].status != Status.RELAXED for each in records)
    assert min(each.distance for each in records) > 0.02
