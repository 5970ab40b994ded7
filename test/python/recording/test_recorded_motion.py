"""Obstacles whose poses came from outside follow what was recorded of them."""

import dataclasses

import numpy as np
import pytest
import yaml

from deformable_manipulation.motion.obstacle_motion import ObstaclePath
from deformable_manipulation.recording.frames import Frames
from deformable_manipulation.recording.recorded_motion import with_recorded_motion
from deformable_manipulation.recording.run_data import RunDataError
from deformable_manipulation.scenario import load_scenario, scenario_from_mapping, scenario_to_yaml
from deformable_manipulation.scenario.files import find_scenario

TIMES = np.arange(0.0, 2.05, 0.1)


def recorded(motion):
    """Frames in which the obstacle goes to the side and turns about its z axis."""
    overrides = [("obstacles.0.motion", motion)] if motion else []
    scenario = load_scenario("rope_moving_obstacle", overrides)
    poses = np.zeros((len(TIMES), 1, 7), np.float32)
    poses[:, 0, 0] = 0.1 * TIMES
    poses[:, 0, 5], poses[:, 0, 6] = np.sin(0.2 * TIMES), np.cos(0.2 * TIMES)
    nothing = np.zeros((len(TIMES), 2, 3), np.float32)
    return Frames(scenario, TIMES, nothing, nothing, obstacles=poses)


@pytest.mark.parametrize("motion", ["{topic: block}", "{frame: block}"])
def test_the_way_is_the_recorded_one(motion):
    frames = recorded(motion)
    path = ObstaclePath(with_recorded_motion(frames).obstacles[0])
    for time, pose in zip(TIMES.tolist(), frames.obstacles[:, 0]):
        found = path.at(time)
        np.testing.assert_allclose(found.translation + found.rotation, pose, atol=1e-6)
    assert path.at(0.55).translation[0] == pytest.approx(0.055, abs=1e-4)


def test_it_can_be_launched():
    text = scenario_to_yaml(with_recorded_motion(recorded("{topic: block}")))
    folder = find_scenario("rope_moving_obstacle").parent
    obstacle = scenario_from_mapping(yaml.safe_load(text), folder).obstacles[0]
    assert len(obstacle.motion.waypoints) == len(TIMES)


def test_a_path_of_the_scenario_stays():
    frames = recorded(None)
    assert with_recorded_motion(frames) is frames.scenario


def test_what_was_not_recorded_is_refused():
    frames = dataclasses.replace(recorded("{topic: block}"), obstacles=None)
    with pytest.raises(RunDataError, match="lacks the poses of the obstacles block"):
        with_recorded_motion(frames)
