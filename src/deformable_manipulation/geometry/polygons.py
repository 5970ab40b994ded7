"""Rings of polygons: reading them from CSV files and checking that they bound a region."""

import math
from typing import Iterable, List, Optional, Sequence, Tuple

from deformable_manipulation.system.text_files import TextFileError, read_text

Ring = Tuple[Tuple[float, float], ...]

LARGEST_COORDINATE = 1e6  # m
_FLATNESS = 1e-12  # twice the area of a triangle over its extent squared: below it is a line
_SMALLEST_EXTENT = 1e-6  # m
_REPORTED_LINES = 5


class PolygonError(ValueError):
    """A ring cannot be read or bounds no region; the message says why, on one line."""


def read_ring(path) -> Ring:
    """Read and check a ring from a CSV file of two columns [m].

    Empty lines and what follows a ``#`` are passed over; the first other line may be a header.

    Raises:
        PolygonError: the file cannot be used; with line numbers where lines are wrong.
    """
    try:
        text = read_text(path)
    except TextFileError as error:
        raise PolygonError("{} {}".format(path, error)) from error
    points, faults = _parse_rows(text)
    if faults:
        shown = faults[:_REPORTED_LINES]
        if len(faults) > len(shown):
            shown.append("and {} lines more".format(len(faults) - len(shown)))
        raise PolygonError("{}: {}".format(path, "; ".join(shown)))
    try:
        return check_ring(points)
    except PolygonError as error:
        raise PolygonError("{}: {}".format(path, error)) from error


def check_ring(points: Iterable[Sequence[float]]) -> Ring:
    """The ring of a simple polygon, closed implicitly, in the order given.

    A last point that repeats the first, and points that repeat the one before, are dropped. Either
    orientation is accepted. Raises PolygonError where a coordinate is not finite or beyond
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


def _parse_rows(text: str) -> Tuple[List[Tuple[float, float]], List[str]]:
    """Points, and what is wrong with lines that hold none."""
    points, faults = [], []
    header_possible = True
    for number, line in enumerate(text.splitlines(), start=1):
        content = line.partition("#")[0].strip()
        if not content:
            continue
        cells = [cell.strip() for cell in content.split(",")]
        numbers = [value for value in map(_to_number, cells) if value is not None]
        is_header = header_possible and not numbers
        header_possible = False
        if len(cells) != 2:
            faults.append(
                "line {} has {} columns, not 2 (separated by a comma)".format(number, len(cells))
            )
        elif is_header:
            continue
        elif len(numbers) < 2:
            faults.append("line {}: '{}' are not two numbers".format(number, content[:40]))
        elif not all(math.isfinite(value) for value in numbers):
            faults.append("line {}: '{}' is not finite".format(number, content[:40]))
        else:
            points.append((numbers[0], numbers[1]))
    return points, faults


def _to_number(cell: str) -> Optional[float]:
    try:
        return float(cell)
    except ValueError:
        return None


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
