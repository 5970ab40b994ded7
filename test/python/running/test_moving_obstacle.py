"""Moving obstacles in the closed loop without ROS."""

import dataclasses
import json

import numpy as np
import pytest

from deformable_manipulation.campaign.variation import Ranges, vary
from deformable_manipulation.commands import run_scenario
from deformable_manipulation.distance.factory import make_minimum_distance
from deformable_manipulation.motion.leader import LeaderPath
from deformable_manipulation.motion.obstacle_motion import MovingObstacles, ObstaclePath
from deformable_manipulation.recording import read_run
from deformable_manipulation.recording.frame_reader import read_frames
from deformable_manipulation.running.closed_loop import ClosedLoop
from deformable_manipulation.scenario import load_scenario

NAME = "rope_moving_obstacle"
SHORTFALL = 0.001  # m, tolerated
RISEN = 9.0  # s, when the block has come up
POSES = [((0.1, -0.2, 0.05), (0.0, 0.0, 0.6, 0.8)), ((0.0, 0.1, 0.1), (0.6, 0.0, 0.0, 0.8))]


@pytest.fixture(scope="module")
def scenario():
    return load_scenario(NAME)


def lowest(*overrides, safety=True):
    """Of the distance until the block has come up [m], and the last decision."""
    loop = ClosedLoop(load_scenario(NAME, overrides), safety)
    records = [loop.step() for _ in range(int(RISEN * 100))]
    return min(record.distance for record in records), records


def test_the_offset_is_kept_with_the_obstacle_s_velocity_and_not_without():
    kept, records = lowest()
    offset = load_scenario(NAME).controller.collision.offset
    assert kept >= offset - SHORTFALL
    # It comes near, and the assistant makes way.
    assert kept < offset + 0.01
    assert max(record.decisions["assistant_1"].error_norm for record in records) > 0.1
    unaware = ("controller.collision.obstacle_velocity", "false")
    assert lowest(unaware, ("controller.disturbance_filter", "0"))[0] < 0.0
    assert lowest(unaware)[0] >= offset - SHORTFALL  # the disturbance observer finds it
    assert lowest(safety=False)[0] < -0.05


def test_the_obstacles_of_a_record_are_those_of_the_path(scenario):
    loop = ClosedLoop(scenario)
    path = ObstaclePath(scenario.obstacles[0])
    for _ in range(500):
        record = loop.step()
        pose = path.at(record.time)
        np.testing.assert_array_equal(record.obstacles, [pose.translation + pose.rotation])
    assert record.obstacles[0, 2] > scenario.obstacles[0].translation[2] + 0.01


def test_distances_are_those_of_an_obstacle_that_stands_there(scenario):
    """With the velocity of the obstacle at its point, in both backends."""
    straight = np.array(scenario.object.pose.position) + [0.0, 0.0, -0.5]
    points = straight + np.linspace(0.0, 1.0, 15)[:, None] * [0.1, 1.4, 0.0]
    for backend in ("native", "reference"):
        moved = make_minimum_distance(
            load_scenario(NAME, [("controller.collision.backend", backend)])
        )
        obstacles = MovingObstacles(scenario)
        for time in (0.0, 5.0, 11.0, 20.0):
            obstacles.move(moved, time)
            pose = ObstaclePath(scenario.obstacles[0]).at(time)
            standing = make_minimum_distance(
                dataclasses.replace(
                    scenario,
                    obstacles=(
                        dataclasses.replace(
                            scenario.obstacles[0],
                            translation=pose.translation,
                            rotation=pose.rotation,
                            motion=None,
                        ),
                    ),
                )
            )
            found, expected = moved.compute(points[None]), standing.compute(points[None])
            assert found.minimum[0] == pytest.approx(expected.minimum[0], abs=1e-6)
            arms = found.obstacle_point - pose.translation
            np.testing.assert_allclose(
                found.obstacle_velocity, pose.linear + np.cross(pose.angular, arms), atol=1e-12
            )


def test_a_run_is_recorded_and_drawn_with_its_obstacles(tmp_path, scenario):
    from deformable_manipulation.plots.overview_plot import plot_overview

    folder = tmp_path / "run"
    options = ("--set", "simulation.duration=6", "--set", "controller.rate=20", "--no-safety")
    assert run_scenario.main([NAME, "--output", str(folder), *options]) == 0
    run = read_run(folder)
    frames = read_frames(run)
    assert frames.obstacles.shape == (len(frames.times), 1, 7)
    path = ObstaclePath(scenario.obstacles[0])
    for time in (0.0, 4.0, 5.5):
        frame = frames.at(time)
        (obstacle,) = frames.obstacles_at(frame)
        expected = path.at(float(frames.times[frame]))
        np.testing.assert_allclose(obstacle.translation, expected.translation, atol=1e-6)
    figure = plot_overview(run, frames, times=[0.0, 5.5])
    drawn = [each.get_paths() for each in figure.axes[0].collections]
    heights = [np.concatenate([path.vertices for path in each])[:, 1].max() for each in drawn]
    assert len(drawn) == 2 and heights[1] > heights[0] + 0.1


@pytest.mark.parametrize("motion, words", [('{topic: "/block"}', "its motion comes"), ("", "")])
def test_obstacles_that_only_ros_moves_stand_and_that_is_told(tmp_path, capsys, motion, words):
    override = ["--set", f"obstacles.0.motion={motion}"] if motion else []
    options = ["--set", "simulation.duration=0.1", "--no-safety", *override]
    assert run_scenario.main([NAME, "--output", str(tmp_path / "run"), *options]) == 0
    assert ("WARNING: obstacle 'block' stands" in capsys.readouterr().err) == bool(words)
    summary = json.loads((tmp_path / "run" / "summary.json").read_text())
    assert summary["completed"]


def test_a_campaign_keeps_the_motion_and_the_leader_clear_of_it(scenario):
    walk = "[{time: 0, position: [0, 0, 0]}, {time: 9, position: [0, 0.5, -0.2]}]"
    scenario = load_scenario(NAME, [("leader.waypoints", walk)])
    ranges = Ranges(duration=40.0)
    shifts = []
    for index in range(2):
        varied = vary(scenario, ranges, 1, index)
        (own,), (block,) = scenario.obstacles, varied.obstacles
        assert block.motion == own.motion
        shifts.append(np.subtract(block.translation, own.translation))
        start = np.array(varied.agents[varied.leader_index].start)
        leader, distance = LeaderPath(varied.leader.waypoints), make_minimum_distance(varied)
        obstacles = MovingObstacles(varied)
        for time in np.linspace(0.0, 40.0, 81):
            obstacles.move(distance, time)
            point = start + leader.position(time)
            assert distance.compute(np.array([[point, point]])).minimum[0] > ranges.clearance - 0.01
    assert abs(shifts[0] - shifts[1]).max() > 1e-3
