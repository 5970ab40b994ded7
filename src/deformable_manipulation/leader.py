"""The leader's scripted motion."""

import math
from bisect import bisect_right

import numpy as np


class LeaderPath:
    """Smooth path through waypoints: twice continuously differentiable, without overshoot.

    Between two waypoints each axis follows the quintic polynomial with the velocities chosen at
    the waypoints and zero accelerations there. The velocity at an inner waypoint is the harmonic
    mean of the mean velocities before and after it, or zero where they differ in sign (Fritsch
    and Butland, 1984), which is less than twice either one. Up to twice the mean velocity these
    quintics are monotone, so every axis stays between the waypoints' values, and its speed is at
    most twice the mean speed of the piece (15/8 of it from rest to rest). At rest before the
    first and after the last waypoint.

    Args:
        waypoints: sequence of objects with ``time`` [s] and ``position`` (3,) [m].

    Raises:
        ValueError: no waypoint, a position that is not three numbers, a number that is not finite,
            or times that do not increase.
    """

    def __init__(self, waypoints):
        if not waypoints:
            raise ValueError("leader.waypoints: empty, at least one waypoint is needed")
        self._times = np.array([waypoint.time for waypoint in waypoints], dtype=float)
        self._positions = _positions(waypoints)
        if not (np.isfinite(self._times).all() and np.isfinite(self._positions).all()):
            raise ValueError("leader.waypoints: all times and positions have to be finite numbers")
        if (np.diff(self._times) <= 0.0).any():
            late = int(np.argmax(np.diff(self._times) <= 0.0)) + 1
            raise ValueError(
                f"leader.waypoints[{late}].time: {self._times[late]}, allowed is more than the "
                f"time of the waypoint before, {self._times[late - 1]}"
            )
        self._coefficients = _coefficients(self._times, self._positions)
        self._starts = self._times[:-1].tolist() or [float(self._times[0])]
        self._durations = np.diff(self._times).tolist() or [1.0]
        self._end = float(self._times[-1])
        self._polynomials = self._coefficients.transpose(0, 2, 1).tolist()  # per piece and axis

    def at(self, t):
        """Position [m] at one time [s] as three numbers, much quicker than :meth:`position`."""
        t = min(max(t, self._starts[0]), self._end)
        i = bisect_right(self._starts, t) - 1
        s = (t - self._starts[i]) / self._durations[i]
        return [
            ((((c5 * s + c4) * s + c3) * s + c2) * s + c1) * s + c0
            for c0, c1, c2, c3, c4, c5 in self._polynomials[i]
        ]

    def position(self, t):
        """Position [m] at the times ``t`` [s]; shape ``t.shape + (3,)``."""
        s, i = self._piece(t)
        return np.einsum("...k,...kj->...j", s[..., None] ** np.arange(6), self._coefficients[i])

    def velocity(self, t):
        """Velocity [m/s] at the times ``t`` [s]; shape ``t.shape + (3,)``."""
        s, i = self._piece(t)
        slopes = np.arange(1, 6) * s[..., None] ** np.arange(5)
        rates = np.einsum("...k,...kj->...j", slopes, self._coefficients[i, 1:])
        return rates / np.array(self._durations)[i][..., None]

    def _piece(self, t):
        """How far each time is in its piece, from 0 to 1, and the number of that piece."""
        t = np.clip(np.asarray(t, dtype=float), self._times[0], self._times[-1])
        i = np.maximum(np.searchsorted(self._starts, t, side="right") - 1, 0)
        return (t - np.array(self._starts)[i]) / np.array(self._durations)[i], i


def _positions(waypoints):
    for index, waypoint in enumerate(waypoints):
        if np.shape(waypoint.position) != (3,):
            raise ValueError(
                f"leader.waypoints[{index}].position: {waypoint.position}, allowed are three "
                "numbers [m]"
            )
    return np.array([waypoint.position for waypoint in waypoints], dtype=float)


def _coefficients(times, positions):
    """(pieces, 6, 3) m, of the powers of s: quintics (Hermite) of zero end accelerations."""
    if len(times) == 1:
        return np.concatenate((positions, np.zeros((5, 3))))[None]
    duration = np.diff(times)[:, None]
    start, change = positions[:-1], np.diff(positions, axis=0)
    velocities = _waypoint_velocities(times, positions)
    v0, v1 = duration * velocities[:-1], duration * velocities[1:]
    return np.stack(
        (
            start,
            v0,
            np.zeros_like(start),
            10.0 * change - 6.0 * v0 - 4.0 * v1,
            -15.0 * change + 8.0 * v0 + 7.0 * v1,
            6.0 * change - 3.0 * v0 - 3.0 * v1,
        ),
        axis=1,
    )


def _waypoint_velocities(times, positions):
    velocities = np.zeros_like(positions)
    means = np.diff(positions, axis=0) / np.diff(times)[:, None]
    before, after = means[:-1], means[1:]
    same_sign = np.sign(before) * np.sign(after) > 0.0
    total = np.where(same_sign, before + after, 1.0)
    velocities[1:-1] = np.where(same_sign, 2.0 * before * (after / total), 0.0)
    return velocities


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
        self._start = [float(value) for value in scenario.agents[scenario.leader_index].start]
        self._cycle_time = scenario.cycle_time
        self._max_return = scenario.controller.max_velocity
        self.reset()

    def reset(self):
        """Forget the previous command: the leader is at rest."""
        self._time = None
        self._velocity = np.zeros(3)

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
