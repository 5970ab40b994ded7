"""Velocities of agents from their stamped positions."""

import math

import numpy as np


class VelocityEstimator:
    """Backward difference over the newest stamped positions.

    The difference of the positions at t - dt and t is the mean velocity of that interval, that
    is the velocity at t - dt / 2. The command computed from it acts from t + dt to t + 2 dt,
    around t + 3 dt / 2: two cycles later. For an agent that accelerates by a, the estimate is
    2 a dt behind by then (2 mm/s for 0.1 m/s^2 at 100 Hz). ``velocity(at)`` extrapolates
    linearly over that time, which quadruples the effect of noise in the positions.

    The position may have any shape: one estimator serves all agents that share their stamps.

    Args:
        min_interval: stamps closer than this [s] count as the same: a difference over less would
            amplify noise without bound.
        jump_back: a stamp older than the newest by more than this [s] means that time was set
            back, and starts the estimate afresh; one that is less old came out of order and is
            ignored.
    """

    def __init__(self, min_interval=1e-4, jump_back=0.2):
        self.min_interval = float(min_interval)
        self.jump_back = float(jump_back)
        self.reset()

    def reset(self):
        """Forget all positions."""
        self._time = None
        self._position = None
        self._velocity = None
        self._velocity_time = None
        self._acceleration = None

    def update(self, time, position):
        """Take in a position [m] stamped with ``time`` [s].

        Returns:
            True if it was accepted: finite, and newer than all before or after a jump back.
        """
        position = np.array(position, dtype=float)
        if not (math.isfinite(time) and np.isfinite(position).all()):
            return False
        if self._time is not None and time < self._time - self.jump_back:
            self.reset()
        if self._time is not None:
            if time < self._time + self.min_interval:
                return False
            self._differentiate(time, position)
        self._time, self._position = float(time), position
        return True

    def _differentiate(self, time, position):
        velocity = (position - self._position) / (time - self._time)
        middle = 0.5 * (time + self._time)
        if self._velocity is not None:
            self._acceleration = (velocity - self._velocity) / (middle - self._velocity_time)
        self._velocity, self._velocity_time = velocity, middle

    def velocity(self, at=None):
        """Velocity [m/s], of the shape of the positions.

        Args:
            at: time [s] to extrapolate to; None: the mean of the newest interval.

        Returns:
            Zeros while fewer than two positions are known.

        Raises:
            RuntimeError: no position is known, so not even the shape.
        """
        if self._position is None:
            raise RuntimeError("no position known yet: call update first")
        if self._velocity is None:
            return np.zeros_like(self._position)
        if at is None or self._acceleration is None:
            return self._velocity
        return self._velocity + (at - self._velocity_time) * self._acceleration
