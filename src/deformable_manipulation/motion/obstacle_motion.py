"""Where moving obstacles are, and how they move."""

from typing import List, NamedTuple

import numpy as np

from deformable_manipulation.geometry.pose import Quaternion, Vector
from deformable_manipulation.geometry.rotation import (
    angular_velocity,
    conjugate,
    from_vector,
    multiply,
    rate_of,
    to_vector,
)
from deformable_manipulation.motion.smooth_path import (
    Pieces,
    SmoothPath,
    polynomial,
    quintics,
    slope,
    waypoint_rates,
)
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
    the leader's are. Between two orientations the rotation vector from the first is a quintic whose
    ends have the angular velocities chosen at the waypoints; it takes the shorter way round.

    Args:
        obstacle: of the scenario, with a PathMotion.
    """

    def __init__(self, obstacle):
        waypoints = obstacle.motion.waypoints
        times = [waypoint.time for waypoint in waypoints]
        positions = np.add(obstacle.translation, [waypoint.position for waypoint in waypoints])
        self._position = SmoothPath(times, positions)
        self._orientation = _OrientationPath(
            np.array(times),
            [multiply(waypoint.orientation, obstacle.rotation) for waypoint in waypoints],
        )

    def at(self, time: float) -> MovingPose:
        """Pose and exact velocity at a time [s] since the start of the run."""
        rotation, angular = self._orientation.at(time)
        return MovingPose(
            tuple(self._position.at(time)), rotation, tuple(self._position.rate_at(time)), angular
        )


class _OrientationPath:
    """Orientations (K) at times (K,) [s], smooth in between."""

    def __init__(self, times, orientations: List[Quaternion]):
        self._pieces = Pieces(times)
        self._starts = orientations
        turns = np.array(
            [to_vector(multiply(b, conjugate(a))) for a, b in zip(orientations, orientations[1:])]
        ).reshape(-1, 3)
        rates = waypoint_rates(times, turns)
        durations = np.diff(times)[:, None]
        last = np.array([rate_of(turn, rate) for turn, rate in zip(turns, rates[1:])])
        self._polynomials = (
            quintics(
                np.zeros_like(turns), turns, durations * rates[:-1], durations * last.reshape(-1, 3)
            )
            .transpose(0, 2, 1)
            .tolist()
        )

    def at(self, time):
        """Orientation and angular velocity [rad/s]."""
        if not self._polynomials:
            return self._starts[0], _AT_REST
        i, s, duration = self._pieces.locate(time)
        turn = [polynomial(coefficients, s) for coefficients in self._polynomials[i]]
        rate = [slope(coefficients, s) / duration for coefficients in self._polynomials[i]]
        return multiply(from_vector(turn), self._starts[i]), angular_velocity(turn, rate)


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
