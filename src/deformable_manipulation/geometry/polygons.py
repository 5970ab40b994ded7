"""Rings of polygons: checking that they bound a region."""

import math
from typing import Any, Iterable, List, Sequence, Tuple, Union

Ring = Tuple[Tuple[float, float], ...]
Rings = Tuple[Ring, ...]
Points = Union[Ring, Rings]  # one ring, or several

LARGEST_COORDINATE = 1e6  # m
_FLATNESS = 1e-12  # twice the area of a triangle over its extent squared: below it is a line
_SMALLEST_EXTENT = 1e-6  # m


class PolygonError(ValueError):
    """Rings cannot be read or bound no region; the message says why, on one line."""


def has_several_rings(points: Sequence[Any]) -> bool:
    """Whether points are rings of pairs of numbers, and not such pairs themselves."""
    return len(points) > 0 and len(points[0]) > 0 and hasattr(points[0][0], "__len__")


def rings_of(points: Any) -> Rings:
    """The rings, of which there may be only one."""
    return tuple(points) if has_several_rings(points) else (points,)


def points_of(rings: Rings) -> Points:
    """A single ring as itself, others as rings."""
    return rings[0] if len(rings) == 1 else rings


def check_rings(points: Points) -> Rings:
    """The rings of a region: a point is in it if an odd number of them are around the point.

    A ring within another one is thus a hole, and rings side by side are pieces. Each ring is as of
    :func:`check_ring`. Raises PolygonError if one is not, and where two cross or touch.
    """
    rings = rings_of(points)
    if len(rings) == 1:
        return (check_ring(rings[0]),)
    checked = []
    for index, ring in enumerate(rings):
        try:
            checked.append(check_ring(ring))
        except PolygonError as error:
            raise PolygonError("ring {}: {}".format(index, error)) from error
    _refuse_meeting(checked)
    return tuple(checked)


def check_ring(points: Iterable[Sequence[float]]) -> Ring:
    """The ring of a simple polygon, closed implicitly, in the order given.

    A last point that repeats the first, and points that repeat the one before, are dropped. Either
    orientation is accepted. Raises PolygonError if a coordinate is not finite or beyond
    LARGEST_COORDINATE, or where the ring has fewer than three distinct points, no area, or crosses
    or touches itself.

    Args:
        points: pairs of coordinates [m].
    """
    pairs = [(float(a), float(b)) for a, b in points]
    for index, pair in enumerate(pairs):
        if not all(math.isfinite(c) and abs(c) <= LARGEST_COORDINATE for c in pair):
            raise PolygonError(
                "point {} is ({:g}, {:g}); coordinates must be finite and at most {:g} m".format(
                    index, pair[0], pair[1], LARGEST_COORDINATE
                )
            )
    distinct = len(set(pairs))
    if distinct < 3:
        raise PolygonError("a polygon needs 3 distinct points or more, not {}".format(distinct))
    ring = _without_repeats(pairs)
    if _is_flat(ring):
        raise PolygonError("the polygon has no area: all its points lie on one line")
    _refuse_crossing(ring)
    return tuple(ring)


def _without_repeats(points: List[Tuple[float, float]]) -> List[Tuple[float, float]]:
    # The last point's successor is the first one: this drops the closing point, too.
    return [point for i, point in enumerate(points) if point != points[i + 1 - len(points)]]


def _is_flat(ring: List[Tuple[float, float]]) -> bool:
    """Whether all points lie on one line, seen from the first point and the farthest from it."""
    origin = ring[0]
    far = max(ring, key=lambda p: math.hypot(p[0] - origin[0], p[1] - origin[1]))
    axis = (far[0] - origin[0], far[1] - origin[1])
    extent = math.hypot(*axis)
    if extent < _SMALLEST_EXTENT:
        return True
    return all(
        abs(axis[0] * (b - origin[1]) - axis[1] * (a - origin[0])) <= _FLATNESS * extent**2
        for a, b in ring
    )


def _refuse_crossing(ring: List[Tuple[float, float]]) -> None:
    import shapely  # takes longer to import than everything else here, and not every run needs it
    from shapely.validation import explain_validity

    polygon = shapely.Polygon(ring)
    if polygon.is_valid:
        return
    # The explanation reads like "Self-intersection[0.5 0.5]".
    reason, _, place = explain_validity(polygon).partition("[")
    raise PolygonError(
        "the polygon crosses or touches itself at ({}) ({})".format(
            ", ".join(place.rstrip("]").split()), reason.lower()
        )
    )


def _refuse_meeting(rings: List[Ring]) -> None:
    import shapely

    lines = [shapely.LinearRing(ring) for ring in rings]
    one, other = shapely.STRtree(lines).query(lines, predicate="intersects")
    for i, j in zip(one.tolist(), other.tolist()):
        if i < j:
            place = shapely.get_coordinates(lines[i].intersection(lines[j]))[0]
            text = "rings {} and {} cross or touch at ({:g}, {:g}); move them apart, or join them"
            raise PolygonError(text.format(i, j, *place))
