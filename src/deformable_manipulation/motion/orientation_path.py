"""Smooth interpolation between orientations at given times."""

from typing import List, Tuple

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
    polynomial,
    quintics,
    slope,
    waypoint_rates,
)

_AT_REST = (0.0, 0.0, 0.0)


class OrientationPath:
    """Orientations at given times, smooth in between, at rest before and after.

    Between two of them the rotation vector from the first is a quintic whose ends have the angular
    velocities chosen at the waypoints; it takes the shorter way round.

    Args:
        times: (K,) s, increasing, K >= 1.
        orientations: K quaternions of norm 1.
    """

    def __init__(self, times, orientations: List[Quaternion]):
        times = np.asarray(times, dtype=float)
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

    def at(self, time: float) -> Tuple[Quaternion, Vector]:
        """Orientation and angular velocity [rad/s] at a time [s]."""
        if not self._polynomials:
            return self._starts[0], _AT_REST
        i, s, duration = self._pieces.locate(time)
        turn = [polynomial(coefficients, s) for coefficients in self._polynomials[i]]
        rate = [slope(coefficients, s) / duration for coefficients in self._polynomials[i]]
        return multiply(from_vector(turn), self._starts[i]), angular_velocity(turn, rate)
