"""Which points of a polyline count as its near features: two answers."""

from typing import NamedTuple

import numpy as np

PROBE = 1e-5  # m, arc length on both sides over which a point has to be the nearest
_DESCENT = 1e-13  # m, over a probe: slopes below 1e-8 count as level
LEVEL = 1e-11  # m, distances that count as the same on a stretch parallel to an edge


class LinePoints(NamedTuple):
    """Points of a polyline and their signed distances to an obstacle."""

    segment: np.ndarray  # (K,) int
    parameter: np.ndarray  # (K,) from 0 at the segment's start to 1 at its end
    distance: np.ndarray  # (K,) m

    def take(self, chosen):
        return LinePoints(*(field[chosen] for field in self))


NO_POINTS = LinePoints(np.zeros(0, dtype=int), np.zeros(0), np.zeros(0))


def nearest_of_segments(approach):
    """The nearest point of each segment that is within the limit.

    Where a segment is level with the obstacle, the middle of the nearest stretch.

    Args:
        approach: approach.Approach of the polyline.

    Returns:
        segment (M,), parameter (M,).
    """
    near = approach.near_segments()
    level = approach.level_candidates()
    if level.segment.size:
        _move_to_middles(approach, near, level)
    return near.segment, near.parameter


def _move_to_middles(approach, near, level):
    """Replace the parameters of segments with level stretches by those of the middles."""
    line = approach.line
    least = np.full(len(line.length), -np.inf)
    least[near.segment] = near.distance
    level = level.take(level.distance <= least[level.segment] + LEVEL)
    low, high = np.zeros((2, len(least)))
    low[near.segment] = high[near.segment] = near.parameter
    np.minimum.at(low, level.segment, level.parameter)
    np.maximum.at(high, level.segment, level.parameter)
    wide = np.flatnonzero((high - low)[near.segment] * line.length[near.segment] > PROBE)
    if wide.size:
        segment = near.segment[wide]
        middle = 0.5 * (low[segment] + high[segment])
        distance = approach.signed_distance(line.points(segment, middle))
        parallel = distance <= near.distance[wide] + LEVEL  # else these are two separate minima
        near.parameter[wide[parallel]] = middle[parallel]


def local_minima(approach):
    """The local minima of the signed distance along a polyline that are within the limit.

    A stretch that is level with the obstacle counts once, by its middle, if the distance grows at
    both its ends. Minima nearer to each other than PROBE count once.

    Args:
        approach: approach.Approach of the polyline.

    Returns:
        segment (M,), parameter (M,).
    """
    line = approach.line
    near = approach.candidates()
    near = near.take(near.distance <= approach.limit)

    def distance_at(places):
        return approach.signed_distance(line.points(*line.locate(places)))

    position = _apart(line.position(near.segment, near.parameter), near.distance)
    before, distance, after = distance_at(
        np.concatenate((position - PROBE, position, position + PROBE))
    ).reshape(3, -1)
    first, last = _level_stretches(position, distance, before, after, distance_at)
    chosen = (before[first] >= distance[first] - _DESCENT) & (
        after[last] >= distance[last] - _DESCENT
    )
    chosen &= ~_terraces(first, last, distance, before, after)
    chosen |= (first <= distance.argmin()) & (distance.argmin() <= last)
    return line.locate(0.5 * (position[first] + position[last])[chosen])


def _apart(position, distance):
    """Sorted positions, of each cluster only the nearest one."""
    order = np.argsort(position)
    position, distance = position[order], distance[order]
    cluster = np.concatenate(((0,), np.cumsum(np.diff(position) > PROBE)))
    order = np.lexsort((distance, cluster))
    leading = order[np.concatenate(((True,), np.diff(cluster) > 0))]
    return position[leading]


def _level_stretches(position, distance, before, after, distance_at):
    """First and last index of every run of points between which the distance stays the same."""
    one, other = distance[:-1], distance[1:]
    joined = np.abs(one - other) <= LEVEL
    joined &= (np.abs(after[:-1] - one) <= _DESCENT) & (np.abs(before[1:] - other) <= _DESCENT)
    gap = np.flatnonzero(joined)
    if gap.size:
        middle = distance_at(0.5 * (position[gap] + position[gap + 1]))
        joined[gap] = np.abs(middle - distance[gap]) <= LEVEL
    ends = np.flatnonzero(~joined)
    return np.concatenate(((0,), ends + 1)), np.concatenate((ends, (len(position) - 1,)))


def _terraces(first, last, distance, before, after):
    """Which stretches only interrupt a descent: they end level, and the next point is nearer."""
    left, right = np.maximum(first - 1, 0), np.minimum(last + 1, len(distance) - 1)
    falls_left = (distance[left] < distance[first] - LEVEL) & (
        np.abs(before[first] - distance[first]) <= _DESCENT
    )
    falls_right = (distance[right] < distance[last] - LEVEL) & (
        np.abs(after[last] - distance[last]) <= _DESCENT
    )
    return falls_left | falls_right


SELECTIONS = {"local": local_minima, "segments": nearest_of_segments}
