"""Smooth interpolation between values at given times."""

from bisect import bisect_right

import numpy as np


class SmoothPath:
    """Values through waypoints: twice continuously differentiable, without overshoot.

    Between two waypoints each component follows the quintic polynomial with the rates chosen at
    the waypoints and zero second derivatives there. The rate at an inner waypoint is that of
    :func:`waypoint_rates`, less than twice the mean rate before and after it. Up to twice the mean
    rate these quintics are monotone, so every component stays between the waypoints' values, and
    its rate is at most twice the mean rate of the piece (15/8 of it from rest to rest). At rest
    before the first and after the last waypoint.

    Args:
        times: (K,) s, increasing, K >= 1.
        values: (K, D).
    """

    def __init__(self, times, values):
        times, values = np.asarray(times, dtype=float), np.asarray(values, dtype=float)
        self._pieces = Pieces(times)
        changes = np.diff(values, axis=0)
        rates = waypoint_rates(times, changes)
        durations = np.diff(times)[:, None]
        self._coefficients = quintics(
            values[:-1], changes, durations * rates[:-1], durations * rates[1:]
        )
        if len(times) == 1:
            self._coefficients = np.concatenate((values, np.zeros((5, values.shape[1]))))[None]
        self._polynomials = self._coefficients.transpose(0, 2, 1).tolist()  # per piece, component

    def at(self, t):
        """Values at one time [s] as a list, much quicker than :meth:`position`."""
        i, s, _ = self._pieces.locate(t)
        return [polynomial(coefficients, s) for coefficients in self._polynomials[i]]

    def rate_at(self, t):
        """Rates of change [1/s] at one time [s] as a list."""
        i, s, duration = self._pieces.locate(t)
        return [slope(coefficients, s) / duration for coefficients in self._polynomials[i]]

    def position(self, t):
        """Values at the times ``t`` [s]; shape ``t.shape + (D,)``."""
        i, s, _ = self._pieces.locate_all(t)
        return np.einsum("...k,...kj->...j", s[..., None] ** np.arange(6), self._coefficients[i])

    def velocity(self, t):
        """Rates of change [1/s] at the times ``t`` [s]; shape ``t.shape + (D,)``."""
        i, s, durations = self._pieces.locate_all(t)
        slopes = np.arange(1, 6) * s[..., None] ** np.arange(5)
        rates = np.einsum("...k,...kj->...j", slopes, self._coefficients[i, 1:])
        return rates / durations[..., None]


class Pieces:
    """The pieces between waypoints, one that lasts forever where there is one waypoint alone.

    Args:
        times: (K,) s, increasing, K >= 1.
    """

    def __init__(self, times):
        self._first, self._end = float(times[0]), float(times[-1])
        self._starts = times[:-1].tolist() or [self._first]
        self._durations = np.diff(times).tolist() or [1.0]

    def locate(self, t):
        """Number of the piece at a time [s], how far that is in it, 0 to 1, and its length [s]."""
        t = min(max(t, self._first), self._end)
        i = bisect_right(self._starts, t) - 1
        return i, (t - self._starts[i]) / self._durations[i], self._durations[i]

    def locate_all(self, t):
        """The same for an array of times."""
        t = np.clip(np.asarray(t, dtype=float), self._first, self._end)
        i = np.maximum(np.searchsorted(self._starts, t, side="right") - 1, 0)
        durations = np.array(self._durations)[i]
        return i, (t - np.array(self._starts)[i]) / durations, durations


def quintics(starts, changes, first, last):
    """Coefficients (K, 6, D) of the powers of s of quintics with zero second derivatives at 0, 1.

    Args:
        starts: (K, D) values at s = 0.
        changes: (K, D) from s = 0 to 1.
        first, last: (K, D) derivatives by s at 0 and 1.
    """
    return np.stack(
        (
            starts,
            first,
            np.zeros_like(starts),
            10.0 * changes - 6.0 * first - 4.0 * last,
            -15.0 * changes + 8.0 * first + 7.0 * last,
            6.0 * changes - 3.0 * first - 3.0 * last,
        ),
        axis=1,
    )


def waypoint_rates(times, changes):
    """Rates (K, D) [1/s] at waypoints, from the changes (K - 1, D) between them.

    Of an inner one the harmonic mean of the mean rates before and after it, or zero if they
    differ in sign (Fritsch and Butland, 1984); zero at the ends.
    """
    rates = np.zeros((len(times), changes.shape[1]))
    means = changes / np.diff(times)[:, None]
    before, after = means[:-1], means[1:]
    same_sign = np.sign(before) * np.sign(after) > 0.0
    total = np.where(same_sign, before + after, 1.0)
    rates[1:-1] = np.where(same_sign, 2.0 * before * (after / total), 0.0)
    return rates


def polynomial(coefficients, s):
    """Value of a quintic."""
    c0, c1, c2, c3, c4, c5 = coefficients
    return ((((c5 * s + c4) * s + c3) * s + c2) * s + c1) * s + c0


def slope(coefficients, s):
    """Derivative of a quintic by s."""
    _, c1, c2, c3, c4, c5 = coefficients
    return (((5.0 * c5 * s + 4.0 * c4) * s + 3.0 * c3) * s + 2.0 * c2) * s + c1
