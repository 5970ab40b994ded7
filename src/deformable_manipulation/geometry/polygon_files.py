"""Polygons from files: CSV and GeoJSON."""

import csv
import math
from pathlib import Path
from typing import List, Optional, Sequence, Tuple

from deformable_manipulation.geometry.geojson import geojson_rings
from deformable_manipulation.geometry.polygons import PolygonError, Rings, check_rings
from deformable_manipulation.system.text_files import TextFileError, read_text

_REPORTED_LINES = 5
_NO_ORIGIN = (0.0, 0.0)


def read_rings(path, origin: Sequence[float] = _NO_ORIGIN) -> Rings:
    """Read and check the rings of a polygon [m] from a file.

    A file that ends in .geojson or .json is GeoJSON (:func:`.geojson.geojson_rings`). Any other is
    a ring in CSV: two columns, separated by a comma, a semicolon or a tab; numbers may be quoted,
    and have decimal commas where no comma separates them. Empty lines and what follows a ``#`` are
    passed over; the first other line may be a header.

    Args:
        path: of the file.
        origin: (2,) what is taken off all coordinates [m].

    Raises:
        PolygonError: the file cannot be used; with line numbers where lines are wrong.
    """
    try:
        text = read_text(path)
        if Path(str(path)).suffix.lower() in (".geojson", ".json"):
            return check_rings(geojson_rings(text, origin))
        return check_rings(_csv_ring(text, origin))
    except TextFileError as error:
        raise PolygonError("{} {}".format(path, error)) from error
    except PolygonError as error:
        raise PolygonError("{}: {}".format(path, error)) from error


def _csv_ring(text: str, origin: Sequence[float]) -> Tuple[Tuple[float, float], ...]:
    points, faults = _parse_rows(text)
    if faults:
        shown = faults[:_REPORTED_LINES]
        if len(faults) > len(shown):
            shown.append("and {} lines more".format(len(faults) - len(shown)))
        raise PolygonError("; ".join(shown))
    return tuple((a - origin[0], b - origin[1]) for a, b in points)


def _parse_rows(text: str) -> Tuple[List[Tuple[float, float]], List[str]]:
    """Points, and what is wrong with lines that hold none."""
    points, faults = [], []
    header_possible = True
    for number, line in enumerate(text.splitlines(), start=1):
        content = line.partition("#")[0].strip()
        if not content:
            continue
        cells = _cells(content)
        numbers = [value for value in map(_to_number, cells) if value is not None]
        is_header = header_possible and not numbers
        header_possible = False
        if len(cells) != 2:
            faults.append(
                "line {} has {} columns, not 2 (separated by a comma, semicolon or tab)".format(
                    number, len(cells)
                )
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


def _cells(line: str) -> List[str]:
    """The cells of a line, by the first separator that makes two of it."""
    found: List[List[str]] = []
    for separator in ";,\t":
        try:
            cells = next(csv.reader([line], delimiter=separator, skipinitialspace=True))
        except csv.Error:  # a cell that is too long
            continue
        found.append([cell.strip().strip("\"'") for cell in cells])
    return next((cells for cells in found if len(cells) == 2), max(found, key=len, default=[line]))


def _to_number(cell: str) -> Optional[float]:
    try:
        return float(cell.replace(",", "."))
    except ValueError:
        return None
