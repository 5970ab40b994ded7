"""Many line segments in a plane, and their distances to many points at once."""

import numpy as np


class SegmentSet:
    """N line segments in a plane.

    A segment of length zero is the point it consists of. All points are homogeneous (u, v, 1):
    distances along and across every segment are then a single matrix product.

    Args:
        start: (N, 2) first points [m].
        step: (N, 2) from there to the last points [m].
    """

    def __init__(self, start, step):
        self.length = np.hypot(step[:, 0], step[:, 1])
        self.middle = start + 0.5 * step
        self.half = 0.5 * self.length[:, None]
        if self.length.size and np.minimum.reduce(self.length) > 0.0:
            self.direction = step / self.length[:, None]
        else:
            self.direction = np.tile((1.0, 0.0), (len(step), 1))
            proper = self.length > 0.0
            self.direction[proper] = step[proper] / self.length[proper, None]
        self._rows = self._lines()

    def _lines(self):
        """Rows (2 N, 3): distance along from the middle, then distance across to the left."""
        rows = np.empty((2, len(self.length), 3))
        rows[0, :, :2] = self.direction
        rows[1, :, 0] = -self.direction[:, 1]
        rows[1, :, 1] = self.direction[:, 0]
        rows[:, :, 2] = -np.einsum("kni,ni->kn", rows[:, :, :2], self.middle)
        return rows.reshape(-1, 3)

    @property
    def start(self):
        """First points (N, 2) [m]."""
        return self.middle - self.half * self.direction

    def coordinates(self, points):
        """Distances [m] of points (M, 3) along each segment from its middle, and across to its
        left: two arrays (N, M)."""
        product = self._rows @ points.T
        return product[: len(self.length)], product[len(self.length) :]

    def measure(self, points):
        """Squared distances (N, M) [m^2] of points (M, 3), and distances along (N, M) [m]."""
        along, across = self.coordinates(points)
        squared = np.abs(along)
        squared -= self.half
        np.maximum(squared, 0.0, out=squared)
        squared *= squared
        across *= across
        squared += across
        return squared, along

    def distances(self, points):
        """Distances (N, M) [m] of points (M, 3)."""
        return np.sqrt(self.measure(points)[0])

    def nearest(self, points):
        """The nearest segment (M,) of each of the points (M, 3), and its nearest point (M, 2)."""
        squared, along = self.measure(points)
        index = squared.argmin(axis=0)
        half = self.half[index, 0]
        position = along[index, np.arange(len(points))]
        position = np.minimum(np.maximum(position, -half), half)
        return index, self.middle[index] + position[:, None] * self.direction[index]

    def parameters(self, along, segment):
        """From 0 at the start to 1 at the end of the segments (K,), at distances along (K,) from
        their middles, which may lie beyond the ends."""
        length = self.length[segment]
        fraction = along / np.where(length > 0.0, length, 1.0) + 0.5
        return np.minimum(np.maximum(fraction, 0.0), 1.0)
