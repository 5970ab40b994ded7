"""Shapes of an object as measured over time, and their CSV files (docs/real_objects.md)."""

import csv
import math
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Dict, Iterator, List, Optional, Sequence, Tuple, Union

import numpy as np

from deformable_manipulation.system.text_files import TextFileError, read_text

_COLUMN = re.compile(r"^([xyz])@(.+)$")
_MOST_MISTAKES = 10  # that are listed


class MeasuredShapesError(ValueError):
    """A recording cannot be used; the message has all reasons, a line each."""


@dataclass(frozen=True)
class MeasuredShapes:
    """Points of an object over time.

    Attributes:
        time: (T,) s, increasing.
        places: of the points on the undeformed object. On a rod (M,) m from its first end,
            increasing; on a fabric (M, 2) or (M, 3), coordinates [m] of its mesh.
        points: (T, M, 3) m in a frame whose z axis points up; NaN where a point was not seen.
    """

    time: np.ndarray
    places: np.ndarray
    points: np.ndarray

    def between(self, start: float, end: float) -> "MeasuredShapes":
        """The part from a time to another [s], both included."""
        inside = (self.time >= start - 1e-9) & (self.time <= end + 1e-9)
        return MeasuredShapes(self.time[inside], self.places, self.points[inside])

    def without_gaps(self) -> np.ndarray:
        """The points (T, M, 3) with those not seen interpolated over time.

        Raises:
            MeasuredShapesError: a point was never seen.
        """
        filled = self.points.copy()
        for point, place in enumerate(self.places):
            seen = np.isfinite(self.points[:, point]).all(axis=1)
            if not seen.any():
                raise MeasuredShapesError(
                    f"the point at {_place_text(place)} m was never seen: remove its columns"
                )
            for axis in range(3):
                filled[:, point, axis] = np.interp(
                    self.time, self.time[seen], self.points[seen, point, axis]
                )
        return filled


def read_measured_shapes(path: Union[str, Path]) -> MeasuredShapes:
    """Read a CSV file.

    Raises:
        MeasuredShapesError: with all that is wrong in it.
    """
    try:
        rows = list(csv.reader(read_text(Path(path)).splitlines()))
    except (TextFileError, csv.Error) as error:
        raise MeasuredShapesError(f"{path}: {error}") from error
    if not rows:
        raise MeasuredShapesError(f"{path}: is empty; its first line must name the columns")
    mistakes = list(_header_mistakes(rows[0]))
    if mistakes:
        raise _error(path, mistakes)
    numbers = np.full((len(rows) - 1, len(rows[0])), math.nan)
    for line, row in enumerate(rows[1:], start=2):
        mistakes += _read_row(row, line, numbers[line - 2])
    mistakes += _time_mistakes(numbers[:, 0])
    if mistakes:
        raise _error(path, mistakes)
    places = np.array([_place(rows[0][first : first + 3]) for first in range(1, len(rows[0]), 3)])
    points = numbers[:, 1:].reshape(len(numbers), len(places), 3)
    return MeasuredShapes(numbers[:, 0], places[:, 0] if places.shape[1] == 1 else places, points)


def write_measured_shapes(path: Union[str, Path], shapes: MeasuredShapes) -> None:
    """Write a CSV file that :func:`read_measured_shapes` reads. Raises OSError."""
    names = [f"{axis}@{_place_text(place)}" for place in shapes.places for axis in "xyz"]
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["time", *names])
        for time, points in zip(shapes.time, shapes.points):
            cells = ("" if math.isnan(x) else f"{x:.6f}" for x in points.ravel())
            writer.writerow([f"{time:.6g}", *cells])


def _error(path, mistakes: Sequence[str]) -> MeasuredShapesError:
    listed = [f"{path}: {mistake}" for mistake in mistakes[:_MOST_MISTAKES]]
    if len(mistakes) > _MOST_MISTAKES:
        listed.append(f"{path}: and {len(mistakes) - _MOST_MISTAKES} more")
    return MeasuredShapesError("\n".join(listed))


def _header_mistakes(names: Sequence[str]) -> Iterator[str]:
    if not names:
        yield "line 1 is empty; it must name the columns"
        return
    if names[0].strip() != "time":
        yield f"column 1 is named '{names[0]}'; it must be time [s]"
    if len(names) < 7 or len(names) % 3 != 1:
        yield (
            f"has {len(names)} columns; they must be time and three for each of two or more points"
        )
        return
    places = []
    for first in range(1, len(names), 3):
        place = _place(names[first : first + 3])
        if place is None:
            yield (
                f"columns {first + 1} to {first + 3} must be named x@S, y@S and z@S with the arc "
                "length S [m] of a rod's point, or the coordinates S = X/Y [m] of a fabric's, not "
                f"{', '.join(names[first : first + 3])}"
            )
        else:
            places.append((first + 1, place))
    yield from _place_mistakes(places)


def _place_mistakes(places: Sequence[Tuple[int, Tuple[float, ...]]]) -> Iterator[str]:
    """Of places with the numbers of their columns."""
    for (_, before), (column, place) in zip(places, places[1:]):
        if len(place) != len(before):
            yield (
                f"column {column} has {len(place)} coordinates, the point before {len(before)}: "
                "give one for a rod, two or three for a fabric, throughout"
            )
        elif len(place) == 1 and not place > before:
            yield f"the arc length {place[0]:g} m of column {column} is not more than the last"
    known: Dict[Tuple[float, ...], int] = {}
    for column, place in places:
        if len(place) > 1 and place in known:
            yield f"column {column} is at the place of column {known[place]}, {_place_text(place)}"
        known.setdefault(place, column)


def _place(names: Sequence[str]) -> Optional[Tuple[float, ...]]:
    """Of the three columns of a point [m]; None if they are not those of one."""
    parts = [_COLUMN.findall(name.strip()) for name in names]
    if [part[0][0] for part in parts if part] != ["x", "y", "z"]:
        return None
    if len({part[0][1] for part in parts}) > 1:
        return None
    numbers = tuple(_number(text) for text in parts[0][0][1].split("/"))
    if len(numbers) > 3 or None in numbers:
        return None
    return numbers if len(numbers) > 1 or numbers[0] >= 0.0 else None


def _place_text(place) -> str:
    return "/".join(f"{number:.6g}" for number in np.atleast_1d(place))


def _number(text: str):
    try:
        value = float(text)
    except ValueError:
        return None
    return value if math.isfinite(value) else None


def _read_row(row: Sequence[str], line: int, to: np.ndarray) -> List[str]:
    """Fill in the numbers of a line; returns what is wrong with it."""
    if len(row) != len(to):
        return [f"line {line} has {len(row)} columns, the first line {len(to)}"]
    mistakes = []
    for column, text in enumerate(row):
        if column > 0 and text.strip().lower() in ("", "nan"):
            continue
        value = _number(text)
        if value is None:
            allowed = (
                "a number" if column == 0 else "a number [m], or nothing where it was not seen"
            )
            mistakes.append(f"line {line}, column {column + 1}: '{text}' must be {allowed}")
        else:
            to[column] = value
    seen = np.isfinite(to[1:]).reshape(-1, 3)
    if (seen.any(axis=1) & ~seen.all(axis=1)).any():
        mistakes.append(f"line {line}: a point lacks one or two of its coordinates")
    return mistakes


def _time_mistakes(time: np.ndarray) -> Iterator[str]:
    if len(time) < 2:
        yield "needs at least two lines of measured shapes"
    with np.errstate(invalid="ignore"):
        for index in np.flatnonzero(np.diff(time) <= 0.0):
            yield f"line {index + 3}: the time {time[index + 1]:g} s is not after the one before"
