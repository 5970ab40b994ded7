"""A polyline in a plane, by segment and by arc length."""

import numpy as np


class Polyline:
    """P points joined by straight segments, some of which may have length zero.

    Args:
        points: (P, 3) homogeneous points (u, v, 1).
    """

    def __init__(self, points):
        self._start = points[:-1]
        self._step = points[1:] - points[:-1]
        self.length = np.sqrt(np.einsum("si,si->s", self._step, self._step))
        self.reached = np.concatenate(((0.0,), np.cumsum(self.length)))  # (P,) m, arc length

    def points(self, segment, parameter):
        """Points (..., 3) at parameters from 0 to 1 on segments, both (...)."""
        return self._start[segment] + parameter[..., None] * self._step[segment]

    def position(self, segment, parameter):
        """Arc length [m] of such points."""
        return self.reached[segment] + parameter * self.length[segment]

    def locate(self, position):
        """Segment and parameter at an arc length [m]; beyond the ends, of the end."""
        segment = np.searchsorted(self.reached, position, side="right") - 1
        segment = np.minimum(np.maximum(segment, 0), len(self.length) - 1)
        length = self.length[segment]
        parameter = (position - self.reached[segment]) / np.where(length > 0.0, length, 1.0)
        return segment, np.minimum(np.maximum(parameter, 0.0), 1.0)
