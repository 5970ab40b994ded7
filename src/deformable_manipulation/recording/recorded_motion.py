"""Obstacles of a recorded run on the ways that they were recorded on."""

import dataclasses

import numpy as np

from deformable_manipulation.motion.obstacle_motion import moving_obstacles, names_without_path
from deformable_manipulation.recording.frames import Frames
from deformable_manipulation.recording.run_data import RunDataError
from deformable_manipulation.scenario.spec import PathMotion, PoseWaypoint, Scenario


def with_recorded_motion(frames: Frames) -> Scenario:
    """The scenario of a run, where all moving obstacles have a path.

    The path of obstacles whose poses came by a topic or tf is what was recorded of them.

    Raises:
        RunDataError: nothing was.
    """
    scenario = frames.scenario
    names = names_without_path(scenario)
    if not names:
        return scenario
    if frames.obstacles is None:
        raise RunDataError(
            "the recording lacks the poses of the obstacles {}; record the topic of the "
            "distances".format(", ".join(names))
        )
    obstacles = list(scenario.obstacles)
    for index, poses in zip(moving_obstacles(scenario), np.moveaxis(frames.obstacles, 1, 0)):
        if obstacles[index].name in names:
            obstacles[index] = _on_path(obstacles[index], frames.times, poses.astype(float))
    return dataclasses.replace(scenario, obstacles=tuple(obstacles))


def _on_path(obstacle, times, poses):
    """The obstacle, at poses (F, 7) at times (F,) [s]."""
    poses[:, 3:] /= np.linalg.norm(poses[:, 3:], axis=1, keepdims=True)
    waypoints = tuple(
        PoseWaypoint(time, tuple(pose[:3]), tuple(pose[3:]))
        for time, pose in zip(times.tolist(), poses.tolist())
    )
    return dataclasses.replace(
        obstacle,
        translation=(0.0, 0.0, 0.0),
        rotation=(0.0, 0.0, 0.0, 1.0),
        motion=PathMotion(waypoints),
    )
