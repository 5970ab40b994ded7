"""Motion within bounds of place, velocity and acceleration."""

import math


class BoundedMotion:
    """Velocity commands that a box, a speed and an acceleration bound, axis by axis.

    A velocity that is commanded in one cycle acts in the next one, for the time of a cycle. An axis
    never moves faster than it can stop within the box, nor towards a target than it can stop there:
    it arrives without overshoot. From outside the box, or faster than allowed, it comes back at the
    acceleration allowed.

    Args:
        lower, upper: corners (3,) of the box [m].
        max_velocity: of every component [m/s], > 0.
        max_acceleration: of every component [m/s^2], > 0.
        cycle_time: [s], > 0.
    """

    def __init__(self, lower, upper, max_velocity, max_acceleration, cycle_time):
        self._lower = tuple(map(float, lower))
        self._upper = tuple(map(float, upper))
        self._max_velocity = max_velocity
        self._cycle_time = cycle_time
        self._step = max_acceleration * cycle_time  # m/s, change of velocity in a cycle

    def towards(self, target, position, velocity):
        """The next velocity (3,) [m/s] on the way to a target, or to the nearest place in the box.

        Args:
            target, position: (3,) m.
            velocity: (3,) m/s, that moves it until the next one acts.
        """
        wanted = [
            self._approach(t - self._next(x, v)) for t, x, v in zip(target, position, velocity)
        ]
        return self.along(wanted, position, velocity)

    def along(self, wanted, position, velocity):
        """The next velocity (3,) [m/s] where ``wanted`` (3,) [m/s] is asked for."""
        return [
            self._bounded(w, low - self._next(x, v), high - self._next(x, v), v)
            for w, low, high, x, v in zip(wanted, self._lower, self._upper, position, velocity)
        ]

    def _next(self, position, velocity):
        """Where an axis is when the next command begins to act."""
        return position + self._cycle_time * velocity

    def _bounded(self, wanted, room_below, room_above, velocity):
        inside = min(max(wanted, self._approach(room_below)), self._approach(room_above))
        slow = min(max(inside, -self._max_velocity), self._max_velocity)
        return min(max(slow, velocity - self._step), velocity + self._step)

    def _approach(self, way):
        """The fastest velocity [m/s] that can be stopped after ``way`` [m], with its sign."""
        # It moves with v for a cycle, then with v - step, v - 2 step ... down to the last of k
        # cycles: in all dt ((k + 1) v - step k (k + 1) / 2).
        dt, step, length = self._cycle_time, self._step, abs(way)
        k = math.floor(0.5 * (math.sqrt(1.0 + 8.0 * length / (step * dt)) - 1.0))
        fastest = length / (dt * (k + 1)) + 0.5 * step * k
        return math.copysign(min(fastest, self._max_velocity), way)
