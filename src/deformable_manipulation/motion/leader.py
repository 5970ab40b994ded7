"""The leader's scripted motion."""

import math

import numpy as np

from deformable_manipulation.geometry.rotation import conjugate, from_vector, multiply, to_vector
from deformable_manipulation.motion.intent import Intent, times_ahead
from deformable_manipulation.motion.orientation_path import OrientationPath
from deformable_manipulation.motion.smooth_path import SmoothPath

_AT_START = 1e-3  # m


class LeaderPath(SmoothPath):
    """The leader's way through its waypoints [m]; see :class:`~.smooth_path.SmoothPath`.

    Args:
        waypoints: sequence of objects with ``time`` [s] and ``position`` (3,) [m].

    Raises:
        ValueError: no waypoint, a position that is not three numbers, a number that is not finite,
            or times that do not increase.
    """

    def __init__(self, waypoints):
        if not waypoints:
            raise ValueError("leader.waypoints: empty, at least one waypoint is needed")
        times = np.array([waypoint.time for waypoint in waypoints], dtype=float)
        positions = _positions(waypoints)
        if not (np.isfinite(times).all() and np.isfinite(positions).all()):
            raise ValueError("leader.waypoints: all times and positions have to be finite numbers")
        if (np.diff(times) <= 0.0).any():
            late = int(np.argmax(np.diff(times) <= 0.0)) + 1
            raise ValueError(
                f"leader.waypoints[{late}].time: {times[late]}, allowed is more than the "
                f"time of the waypoint before, {times[late - 1]}"
            )
        super().__init__(times, positions)


def _positions(waypoints):
    for index, waypoint in enumerate(waypoints):
        if np.shape(waypoint.position) != (3,):
            raise ValueError(
                f"leader.waypoints[{index}].position: {waypoint.position} must be three numbers [m]"
            )
    return np.array([waypoint.position for waypoint in waypoints], dtype=float)


class LeaderTurning:
    """Angular velocity command that keeps the leader's orientation on its path.

    As :class:`LeaderController` does for the position: the command puts the grip exactly where the
    path has it when the command ends to act. Only the return to the path is limited, to
    ``controller.max_angular_velocity`` in all.

    Args:
        scenario: :class:`~deformable_manipulation.scenario.spec.Scenario`; the waypoints turn the
            grip from the leader's orientation at the start.
    """

    def __init__(self, scenario):
        waypoints = scenario.leader.waypoints
        start = scenario.agents[scenario.leader_index].orientation
        self.turns = any(waypoint.is_turned for waypoint in waypoints)
        self._path = OrientationPath(
            [waypoint.time for waypoint in waypoints],
            [multiply(waypoint.orientation, start) for waypoint in waypoints],
        )
        self._cycle_time = scenario.cycle_time
        self._max_return = scenario.controller.max_angular_velocity
        self.reset()

    def reset(self):
        """Forget the previous command: the grip is at rest."""
        self._time = None
        self._velocity = np.zeros(3)

    def update(self, time, orientation):
        """Angular velocity command [rad/s] (3,) for one state; see LeaderController.update.

        Args:
            time: of the state [s], since the start of the run.
            orientation: of the leader's grip, a quaternion of norm 1.
        """
        if not self.turns or not all(map(math.isfinite, (time, *orientation))):
            self._velocity = np.zeros(3)
            return self._velocity
        if self._time is not None and time < self._time - 1.0:
            self.reset()
        if self._time is None or time > self._time:
            self._velocity = self._command(time, tuple(map(float, orientation)))
            self._time = time
        return self._velocity

    def _command(self, time, orientation):
        dt = self._cycle_time
        begin, end = self._path.at(time + dt)[0], self._path.at(time + 2.0 * dt)[0]
        then = multiply(from_vector(dt * self._velocity), orientation)
        back = np.array(to_vector(multiply(begin, conjugate(then)))) / dt
        back *= self._max_return / max(self._max_return, float(np.linalg.norm(back)))
        return np.array(to_vector(multiply(end, conjugate(begin)))) / dt + back


class LeaderController:
    """Velocity command that keeps the leader's held point on its path.

    The command computed from state k (time t, position x) acts from t + dt to t + 2 dt. Until
    then the leader moves with the command before it, so

        v = (path(t + 2 dt) - (x + dt v_previous)) / dt

    puts it exactly on the path at t + 2 dt. On the path this is the mean velocity of the path
    over that cycle, which is not limited: the path itself sets the speed (:class:`LeaderPath`).
    Only the return to the path after a disturbance is limited, to ``controller.max_velocity``
    per component, so that a displaced leader comes back without a leap.

    Args:
        scenario: :class:`~deformable_manipulation.scenario.spec.Scenario`; the path is relative
            to the leader's start.
    """

    def __init__(self, scenario):
        self._path = LeaderPath(scenario.leader.waypoints)
        self._duration = max(0.0, scenario.leader.waypoints[-1].time)
        self._start = [float(value) for value in scenario.agents[scenario.leader_index].start]
        self._cycle_time = scenario.cycle_time
        self._max_return = scenario.controller.max_velocity
        self._ahead = times_ahead(scenario)
        self.reset()

    def reset(self):
        """Forget the previous command: the leader is at rest."""
        self._time = None
        self._velocity = np.zeros(3)

    def time_at(self, position):
        """The time [s] at which the path comes nearest to a position (3,) [m]; 0 at the start."""
        offset = np.asarray(position, dtype=float) - self._start
        if np.abs(offset).max() < _AT_START:
            return 0.0
        times = np.arange(0.0, self._duration + self._cycle_time, self._cycle_time)
        distances = np.linalg.norm(self._path.position(times) - offset, axis=1)
        return float(times[distances.argmin()])

    def update(self, time, position):
        """Velocity command [m/s] (3,) for one state.

        Args:
            time: of the state [s], since the start of the run. A time that is not newer than the
                last one gets the same answer; an earlier one by more than a second means that
                time was set back.
            position: (3,) of the leader's held point [m].

        Returns:
            Zero for a time or position that is not finite.
        """
        position = np.asarray(position, dtype=float)
        if not all(map(math.isfinite, (time, *position.tolist()))):
            self._velocity = np.zeros(3)
            return self._velocity
        if self._time is not None and time < self._time - 1.0:
            self.reset()
        if self._time is None or time > self._time:
            self._velocity = self._command(time, position)
            self._time = time
        return self._velocity

    def intent(self, time):
        """The Intent at a time [s] since the start of the run: the path from then on."""
        times = time + self._ahead
        return Intent(times, self._start + self._path.position(times))

    def _command(self, time, position):
        dt = self._cycle_time
        limit = self._max_return
        velocity = []
        for begin, end, start, x, v in zip(
            self._path.at(time + dt),
            self._path.at(time + 2.0 * dt),
            self._start,
            position.tolist(),
            self._velocity.tolist(),
        ):
            back = (start + begin - (x + dt * v)) / dt
            velocity.append((end - begin) / dt + min(max(back, -limit), limit))
        return np.array(velocity)
