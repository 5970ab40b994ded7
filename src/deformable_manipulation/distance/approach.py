"""How near polylines come to one planar obstacle."""

import numpy as np

from deformable_manipulation.distance.polyline import Polyline
from deformable_manipulation.distance.segments import SegmentSet
from deformable_manipulation.distance.selection import LEVEL, NO_POINTS, LinePoints

_ROUNDING = 1e-12  # m


class Approach:
    """How near C polylines of S segments come to one obstacle.

    Args:
        obstacle: PlanarObstacle.
        lines: (C, S + 1, 3) polylines in its plane, homogeneous.
        squared: (C, S + 1) squared distances of their points to the boundary [m^2].
        touching: (C,) whether a polyline touches or enters the polygon.
        band: how far beyond its minimum the first polyline is looked at [m].

    Attributes:
        segment, parameter: (C,) the nearest or deepest point of each polyline.
        distance: (C,) its signed distance [m].
        touching: as given.
        limit: largest signed distance of the first polyline's features [m].
    """

    def __init__(self, obstacle, lines, squared, touching, band):
        self._obstacle = obstacle
        self._lines = lines
        self.touching = touching
        self._distances = np.full((len(lines), lines.shape[1] - 1), np.inf)
        self._parameters = np.zeros(self._distances.shape)
        self._inside = None
        self._boundary = _BoundaryDistances(obstacle, lines, squared, band)
        self._enter(self._boundary)
        if touching.any():
            self._enter_depths(band)
        copies = np.arange(len(lines))
        self.segment = self._distances.argmin(axis=1)
        self.parameter = self._parameters[copies, self.segment]
        self.distance = self._distances[copies, self.segment]
        self.limit = self.distance[0] + band

    @property
    def line(self):
        """The first polyline."""
        return Polyline(self._lines[0])

    def signed_distance(self, flat):
        """Signed distances (K,) [m] of points (K, 3) of the first polyline, homogeneous."""
        return self._obstacle.signed_distance(flat, self.touching[0])

    def near_segments(self):
        """LinePoints: the nearest point of each of the first polyline's segments in the limit."""
        segment = np.flatnonzero(self._distances[0] <= self.limit)
        return LinePoints(segment, self._parameters[0, segment], self._distances[0, segment])

    def candidates(self):
        """LinePoints: all points of the first polyline that can be local minima within the limit.

        Between two neighbouring ones the signed distance has no local minimum.
        """
        return self._with_inside(self._boundary.candidates(slice(0, self._boundary.own)))

    def level_candidates(self):
        """LinePoints: the candidates of those segments that have several nearest points, if any."""
        chosen = self._boundary.ambiguous()
        if not chosen.size and not self.touching[0]:
            return NO_POINTS
        return self._with_inside(self._boundary.candidates(chosen))

    def _enter(self, boundary):
        self._distances[boundary.copy, boundary.segment] = boundary.distance
        self._parameters[boundary.copy, boundary.segment] = boundary.parameter

    def _enter_depths(self, band):
        """Let the depth take the place of the distance to the boundary where a line is inside."""
        rows = np.flatnonzero(self.touching)
        deep = self._obstacle.deepest(self._lines[rows], np.where(rows == 0, band, 0.0))
        copy, order = rows[deep.line], np.argsort(deep.depth)
        place = copy[order], deep.segment[order]  # the last one assigned, the deepest, remains
        self._distances[place] = -deep.depth[order]
        self._parameters[place] = deep.parameter[order]
        own = copy == 0
        self._inside = LinePoints(deep.segment[own], deep.parameter[own], -deep.depth[own])

    def _with_inside(self, outside):
        if not self.touching[0]:
            return outside
        flat = self.line.points(outside.segment, outside.parameter)
        outside = outside.take(~self._obstacle.contains(flat))
        return LinePoints(*map(np.concatenate, zip(outside, self._inside)))


class _BoundaryDistances:
    """Distances to the boundary, not signed, of the segments that can hold a minimum.

    Attributes:
        copy, segment: (N,) which segments, those of the first polyline in front.
        distance: (N,) [m].
        parameter: (N,) of a nearest point.
        own: how many are of the first polyline.
    """

    def __init__(self, obstacle, lines, squared, band):
        distances = np.sqrt(squared)
        limit = np.minimum.reduce(distances, axis=1)
        limit[0] += band
        step = lines[:, 1:, :2] - lines[:, :-1, :2]
        self.copy, self.segment = _segments_within(distances, step, limit)
        place = self.copy, self.segment
        self._pieces = pieces = SegmentSet(lines[:, :-1, :2][place], step[place])
        self._to_corners, self._along = pieces.measure(obstacle.corners)
        corner = self._to_corners.argmin(axis=1)
        row = np.arange(len(corner))
        to_corner = self._to_corners[row, corner]
        self._from_start, self._from_end = squared[:, :-1][place], squared[:, 1:][place]
        to_end = np.minimum(self._from_start, self._from_end)
        self.distance = np.sqrt(np.minimum(to_end, to_corner))
        self.parameter = np.where(
            to_corner <= to_end,
            pieces.parameters(self._along[row, corner], row),
            self._from_start > self._from_end,
        )
        self.own = np.searchsorted(self.copy, 1)
        self._limit = limit[0]

    def ambiguous(self):
        """Indices of the first polyline's segments that have several nearest points."""
        own = slice(0, self.own)
        level = (self.distance[own] + LEVEL) ** 2
        several = np.add.reduce(self._to_corners[own] <= level[:, None], axis=1) > 1
        several |= (self._from_start[own] <= level) & (self.parameter[own] > 0.0)
        several |= (self._from_end[own] <= level) & (self.parameter[own] < 1.0)
        return np.flatnonzero(several)

    def candidates(self, chosen):
        """LinePoints of the ends of some segments and of the points on them nearest to a corner,
        as far as they can be the nearest to the boundary."""
        segment, length = self.segment[chosen], self._pieces.length[chosen]
        from_start, from_end = np.sqrt((self._from_start[chosen], self._from_end[chosen]))
        squared = self._to_corners[chosen]
        row, corner = np.nonzero(squared <= self._limit**2)
        distance = np.sqrt(squared[row, corner])
        way = self._along[chosen][row, corner] + 0.5 * length[row]
        # The boundary is at most as far as from either end of the segment and along it.
        upper = np.minimum(from_start[row] + way, from_end[row] + length[row] - way)
        inner = (way > 0.0) & (way < length[row]) & (distance <= upper + _ROUNDING)
        row, way, distance = row[inner], way[inner], distance[inner]
        return LinePoints(
            np.concatenate((segment, segment, segment[row])),
            np.concatenate((np.zeros(len(segment)), np.ones(len(segment)), way / length[row])),
            np.concatenate((from_start, from_end, distance)),
        )


def _segments_within(distances, step, limit):
    """Copy and number of the segments that may come within the limits (C,) [m].

    A distance changes by no more than the way along the segment.
    """
    lower = distances[:, 1:] + distances[:, :-1]
    lower -= np.hypot(step[..., 0], step[..., 1])
    index = np.flatnonzero(lower <= (2.0 * limit + _ROUNDING)[:, None])
    return np.divmod(index, step.shape[1])
