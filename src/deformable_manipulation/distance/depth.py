"""How deep polylines are inside a polygon.

The depth of a point inside is its distance to the boundary, the smallest of its distances to the
boundary's edges. Each of these is convex along a straight piece, so that their minimum has its
local maxima only where two of them are equal, or at the ends of the piece. Edges that can be the
nearest on a piece are told from the others by bounds; pieces where they are many are halved.
"""

from typing import NamedTuple

import numpy as np
import shapely

from deformable_manipulation.distance.segments import SegmentSet

_MOST_EDGES = 8  # that are compared pair by pair on one piece
_SHORTEST = 1e-10  # m, pieces that are not halved any more: error of the depth at most half of it
_CORNER_TOLERANCE = 1e-9  # m, so that no crossing slips through between two edges
_ENVELOPE_TOLERANCE = 1e-7  # m, between an equidistant point's distance and the depth there


class DeepPoints(NamedTuple):
    """Points of polylines inside a polygon."""

    line: np.ndarray  # (K,) int
    segment: np.ndarray  # (K,) int
    parameter: np.ndarray  # (K,) from 0 at the segment's start to 1 at its end
    depth: np.ndarray  # (K,) m


class _Pieces(NamedTuple):
    """Straight pieces inside the polygon, parts of segments."""

    segment: np.ndarray  # (K,) int, counted over all lines
    first: np.ndarray  # (K,) parameter on the segment
    last: np.ndarray  # (K,)
    distances_first: np.ndarray  # (E, K) m, of the piece's first point to every edge
    distances_last: np.ndarray  # (E, K) m

    def take(self, chosen):
        return _Pieces(*(field[..., chosen] for field in self))


class _Segments(NamedTuple):
    start: np.ndarray  # (N, 3) homogeneous
    step: np.ndarray  # (N, 3) to the end

    def points(self, segment, parameter):
        return self.start[segment] + parameter[:, None] * self.step[segment]


def deepest_points(edges, polygon, lines, slack):
    """Every local maximum of the depth along polylines that is near the deepest, and more points.

    Args:
        edges: SegmentSet of the polygon's ring, in order.
        polygon: the same as a prepared shapely.Polygon.
        lines: (T, P, 3) polylines as homogeneous points.
        slack: (T,) how far below the line's deepest point a maximum still counts [m].

    Returns:
        DeepPoints. Between two neighbours of them on a piece inside that reaches a depth within
        the slack, the depth is monotonic, to 1e-10 m. Every segment with a part inside has some.
    """
    count = lines.shape[1] - 1
    segments = _Segments(
        lines[:, :-1].reshape(-1, 3), (lines[:, 1:] - lines[:, :-1]).reshape(-1, 3)
    )
    segment, first, last = _parts_inside(edges, polygon, segments)
    pieces = _Pieces(
        segment,
        first,
        last,
        edges.distances(segments.points(segment, first)),
        edges.distances(segments.points(segment, last)),
    )
    found = [
        (segment, first, pieces.distances_first.min(axis=0)),
        (segment, last, pieces.distances_last.min(axis=0)),
    ]
    deepest = np.zeros(len(lines))
    for of_segment, _, depth in found:
        np.maximum.at(deepest, of_segment // count, depth)
    while True:
        ceiling = np.maximum(pieces.distances_first, pieces.distances_last).min(axis=0)
        line = pieces.segment // count
        pieces = pieces.take(ceiling >= (deepest - slack)[line] - _SHORTEST)
        if not pieces.segment.size:
            break
        simple = _solve(edges, segments, pieces, found)
        pieces = _halve(edges, segments, pieces.take(~simple), found)
        for of_segment, _, depth in found[-2:]:
            np.maximum.at(deepest, of_segment // count, depth)
    segment, parameter, depth = (np.concatenate(parts) for parts in zip(*found))
    return DeepPoints(segment // count, segment % count, parameter, depth)


def _parts_inside(edges, polygon, segments):
    """Segments cut where they cross the boundary: segment (K,), first and last parameter (K,) of
    the parts that are inside."""
    along_start, across_start = edges.coordinates(segments.start)
    along_end, across_end = edges.coordinates(segments.start + segments.step)
    with np.errstate(divide="ignore", invalid="ignore"):
        crossing = across_start / (across_start - across_end)  # not finite where parallel
        along = along_start + crossing * (along_end - along_start)
        hit = (crossing > 0.0) & (crossing < 1.0)
        hit &= np.abs(along) <= edges.half + _CORNER_TOLERANCE
    every = np.arange(len(segments.start))
    segment = np.concatenate((every, every, np.nonzero(hit)[1]))
    parameter = np.concatenate((np.zeros(every.size), np.ones(every.size), crossing[hit]))
    order = np.lexsort((parameter, segment))
    segment, parameter = segment[order], parameter[order]
    part = np.flatnonzero((segment[1:] == segment[:-1]) & (parameter[1:] > parameter[:-1]))
    segment, first, last = segment[part], parameter[part], parameter[part + 1]
    middle = segments.points(segment, 0.5 * (first + last))
    inside = shapely.contains_xy(polygon, middle[:, 0], middle[:, 1])
    return segment[inside], first[inside], last[inside]


def _solve(edges, segments, pieces, found):
    """Append the extrema of the depth on the simple pieces to ``found``; which are simple (K,)."""
    first = segments.points(pieces.segment, pieces.first)
    last = segments.points(pieces.segment, pieces.last)
    ceiling = np.maximum(pieces.distances_first, pieces.distances_last).min(axis=0)
    cuts = SegmentSet(first[:, :2], (last - first)[:, :2])
    floor = _least_distances(edges, cuts, pieces)
    simple = (floor <= ceiling).sum(axis=0) <= _MOST_EDGES
    simple |= cuts.length <= _SHORTEST
    if simple.any():
        nearest = np.argsort(floor[:, simple], axis=0)[:_MOST_EDGES]
        column, fraction, distance = _equidistant(
            edges, nearest, first[simple], last[simple], ceiling[simple] + _SHORTEST
        )
        piece = np.flatnonzero(simple)[column]
        segment = pieces.segment[piece]
        parameter = pieces.first[piece] + fraction * (pieces.last - pieces.first)[piece]
        depth = edges.distances(segments.points(segment, parameter)).min(axis=0)
        extremal = np.abs(depth - distance) <= _ENVELOPE_TOLERANCE
        found.append((segment[extremal], parameter[extremal], depth[extremal]))
    return simple


def _least_distances(edges, cuts, pieces):
    """Distances (E, K) [m] between edges and pieces, which do not cross each other."""
    corners = np.column_stack((edges.start, np.ones(len(edges.length))))
    from_corner = cuts.distances(corners).T
    return np.minimum.reduce(
        (
            pieces.distances_first,
            pieces.distances_last,
            from_corner,
            np.roll(from_corner, -1, axis=0),
        )
    )


def _equidistant(edges, nearest, first, last, ceiling):
    """Where a piece is equally far from two of its nearest edges, or nearest to one of them.

    An edge counts as its line and its first corner; squared distances to both are quadratic in
    the fraction of the piece. Returns piece (R,), fraction (R,), distance (R,) [m] of all that
    are not above ``ceiling`` (K,).
    """
    sites = _squared_distances_along(edges, nearest, first, last)
    one, other = np.triu_indices(sites.shape[1], 1)
    a, b, c = sites[:, one] - sites[:, other]
    with np.errstate(divide="ignore", invalid="ignore"):
        root = np.sqrt(np.maximum(b * b - 4.0 * a * c, 0.0))
        stable = -0.5 * (b + np.copysign(root, b))
        lowest = -0.5 * sites[1] / sites[0]
        fraction = np.concatenate((stable / a, c / stable, lowest))
    site = np.concatenate((one, one, np.arange(sites.shape[1])))
    row, column = np.nonzero((fraction > 0.0) & (fraction < 1.0))
    fraction = fraction[row, column]
    a, b, c = sites[:, site[row], column]
    distance = np.sqrt(np.maximum((a * fraction + b) * fraction + c, 0.0))
    near = distance <= ceiling[column]
    return column[near], fraction[near], distance[near]


def _squared_distances_along(edges, nearest, first, last):
    """Coefficients (3, 2 m, K), highest power first, of squared distances along K pieces to the
    lines and to the first corners of the edges ``nearest`` (m, K)."""
    across = np.take_along_axis(edges.coordinates(first)[1], nearest, axis=0)
    change = np.take_along_axis(edges.coordinates(last)[1], nearest, axis=0) - across
    step = (last - first)[:, :2]
    arm = first[:, :2] - edges.start[nearest]
    lines = (change**2, 2.0 * across * change, across**2)
    corners = (
        np.broadcast_to(np.einsum("ki,ki->k", step, step), nearest.shape),
        2.0 * np.einsum("mki,ki->mk", arm, step),
        np.einsum("mki,mki->mk", arm, arm),
    )
    return np.concatenate((lines, corners), axis=1)


def _halve(edges, segments, pieces, found):
    """Both halves of every piece; their common points are appended to ``found``."""
    middle = 0.5 * (pieces.first + pieces.last)
    distances = edges.distances(segments.points(pieces.segment, middle))
    found.append((pieces.segment, middle, distances.min(axis=0)))
    fronts = pieces._replace(last=middle, distances_last=distances)
    backs = pieces._replace(first=middle, distances_first=distances)
    return _Pieces(*(np.concatenate(pair, axis=-1) for pair in zip(fronts, backs)))
