"""Where moving obstacles are, and how they move."""

from typing import List, NamedTuple

import numpy as np

from deformable_manipulation.geometry.pose import Quaternion, Vector
from deformable_manipulation.geometry.rotation import multiply
from deformable_manipulation.motion.orientation_path import OrientationPath
from deformable_manipulation.motion.smooth_path import SmoothPath
from deformable_manipulation.scenario.spec import PathMotion

_AT_REST = (0.0, 0.0, 0.0)


class MovingPose(NamedTuple):
    """Pose and velocity of an obstacle's origin in the fixed frame."""

    translation: Vector  # m
    rotation: Quaternion
    linear: Vector = _AT_REST  # m/s
    angular: Vector = _AT_REST  # rad/s


class ObstaclePath:
    """The way of an obstacle whose motion is a path of the scenario.

    Positions are added to the obstacle's own translation, along the axes of the fixed frame;
    orientations turn it about its origin, from its own rotation. Positions are interpolated as
    the leader's are, orientations as :class:`~.orientation_path.OrientationPath` does.

    Args:
        obstacle: of the scenario, with a PathMotion.
    """

    def __init__(self, obstacle):
        waypoints = obstacle.motion.waypoints
        times = [waypoint.time for waypoint in waypoints]
        positions = np.add(obstacle.translation, [waypoint.position for waypoint in waypoints])
        self._position = SmoothPath(times, positions)
        self._orientation = OrientationPath(
            times,
            [multiply(waypoint.orientation, obstacle.rotation) for waypoint in waypoints],
        )

    def at(self, time: float) -> MovingPose:
        """Pose and exact velocity at a time [s] since the start of the run."""
        rotation, angular = self._orientation.at(time)
        return MovingPose(
            tuple(self._position.at(time)), rotation, tuple(self._position.rate_at(time)), angular
        )


class MovingObstacles:
    """All obstacles of a scenario that move, each where it is now.

    Obstacles without a path stay where the scenario puts them until :meth:`put` says otherwise.

    Args:
        scenario: :class:`~deformable_manipulation.scenario.spec.Scenario`.
    """

    def __init__(self, scenario):
        self._poses = {
            index: MovingPose(obstacle.translation, obstacle.rotation)
            for index, obstacle in enumerate(scenario.obstacles)
            if obstacle.motion is not None
        }
        self._paths = {
            index: ObstaclePath(scenario.obstacles[index])
            for index in self._poses
            if isinstance(scenario.obstacles[index].motion, PathMotion)
        }

    def move(self, distance, time):
        """Follow the paths to a time [s] since the start of the run.

        Args:
            distance: the minimum distance, whose obstacles are moved.
        """
        for index, path in self._paths.items():
            self.put(distance, index, path.at(time))

    def put(self, distance, index, pose: MovingPose):
        """Move one obstacle to a pose."""
        self._poses[index] = pose
        distance.set_pose(index, pose)

    def poses(self) -> np.ndarray:
        """Translation and rotation (K, 7) of the K moving obstacles, in the scenario's order."""
        return np.array([pose[0] + pose[1] for pose in self._poses.values()]).reshape(-1, 7)


def names_without_path(scenario) -> List[str]:
    """Names of the obstacles that move by a topic or tf, and stand where there is no ROS."""
    moving = (scenario.obstacles[index] for index in moving_obstacles(scenario))
    return [each.name for each in moving if not isinstance(each.motion, PathMotion)]


def moving_obstacles(scenario) -> List[int]:
    """Indices (K) of the obstacles that move."""
    return [i for i, obstacle in enumerate(scenario.obstacles) if obstacle.motion is not None]


def placed_obstacles(scenario, poses):
    """The obstacles of a scenario with the moving ones at poses (K, 7)."""
    obstacles = list(scenario.obstacles)
    for index, pose in zip(moving_obstacles(scenario), np.asarray(poses, dtype=float).tolist()):
        obstacles[index] = obstacles[index].at(tuple(pose[:3]), tuple(pose[3:]))
    return tuple(obstacles)


def obstacle_places(obstacle, count):
    """An obstacle at so many times of its path; itself alone where it has no path."""
    if not isinstance(obstacle.motion, PathMotion):
        return [obstacle]
    path, waypoints = ObstaclePath(obstacle), obstacle.motion.waypoints
    times = np.linspace(waypoints[0].time, waypoints[-1].time, count)
    return [obstacle.at(*path.at(time)[:2]) for time in times.tolist()]
