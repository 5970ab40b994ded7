"""The shape that a rod has without load: coils from the drum, pre-bent tubes."""

import dataclasses
import math
from dataclasses import dataclass
from typing import Optional, Tuple

import numpy as np

from deformable_manipulation.cloud_formats import text
from deformable_manipulation.geometry.pose import Vector
from deformable_manipulation.mesh_formats.faces import FormatError
from deformable_manipulation.reading.parameter import parameter
from deformable_manipulation.reading.readers import (
    Array,
    Node,
    Number,
    Section,
    position,
    read_items,
)
from deformable_manipulation.system.package_files import resolve_file

_RATE = 1e4  # 1/m
_SHARPEST_JOINT = 1.0  # rad, as in rod_parameters.cpp
_LENGTH_TOLERANCE = 0.05


class CentreLine:
    """Points along a line: a list of them, or the name of a file with a point on each line."""

    type, unit, range = "file or list", "m", "2 points or more"
    allowed = (
        "a list of at least two points [x, y, z], or the name of a text file with x, y, z on each "
        "line"
    )
    _point = position()

    def __call__(self, node: Node) -> Tuple[Vector, ...]:
        if isinstance(node.value, str):
            points = self._read_file(node)
        elif isinstance(node.value, (list, tuple)):
            points = read_items(node, self._point)
        else:
            node.fail("must be {}".format(self.allowed))
        if len(points) == 1 or (not points and isinstance(node.value, str)):
            node.fail("must be {}; it has {}".format(self.allowed, len(points)))
        for number, (before, after) in enumerate(zip(points, points[1:]), start=1):
            if before == after:
                node.fail(
                    "must be points along a line, but the points {} and {} are the same: leave "
                    "one out".format(number - 1, number)
                )
        return points

    def _read_file(self, node: Node) -> Tuple[Vector, ...]:
        try:
            path = resolve_file(node.value, node.directory)
            with open(str(path), "rb") as file:
                rows = text.read(file.read())
        except (OSError, ValueError, FormatError) as error:
            node.fail("must be {}: {}".format(self.allowed, error))
        if not np.all(np.isfinite(rows)):
            node.fail("must be {}: the file has numbers that are not finite".format(self.allowed))
        return tuple((float(x), float(y), float(z)) for x, y, z in rows)


@dataclass(frozen=True)
class NaturalShape:
    """A uniform curvature and twist, or a centre line."""

    curvature: Tuple[float, float] = parameter(
        Array(2, Number("1/m", at_least=-_RATE, at_most=_RATE), "[about y, about z]"),
        "Curvature about the y and the z axis of the segments: `[0.0, 2.0]` makes an arc of radius "
        "0.5 m, with twist a helix.",
        default=(0.0, 0.0),
        native=True,
    )
    twist: float = parameter(
        Number("rad/m", at_least=-_RATE, at_most=_RATE),
        "Turn of the segments about their x axis, per length.",
        default=0.0,
        native=True,
    )
    points: Tuple[Vector, ...] = parameter(
        CentreLine(),
        "The centre line, in place of `curvature`: points `[x, y, z]` from the first end to the "
        "last, or a file with a point on each line. It is straight between the points, so give "
        "more of them than there are segments. Where it begins along x, its y and z axes are those "
        "of the first segment.",
        default=(),
        default_text="none",
        allowed="as long as the rod to 5 %; without `curvature`",
        native=True,
    )


NATURAL_SHAPE = Section(NaturalShape)


def check_natural_shape(
    node: Node, shape: Optional[NaturalShape], length: float, segments: int
) -> bool:
    """Report what does not go together with a rod of a length [m] in segments.

    Returns:
        Whether there is such a shape.
    """
    if shape is None:
        return True
    node = dataclasses.replace(node, path=node.path + ("natural_shape",))
    if shape.points and shape.curvature != (0.0, 0.0):
        node.report.add(
            node.path, "must have either curvature or points, not both: remove one of them"
        )
        return False
    if shape.points:
        return _check_points(node, shape, length, segments)
    piece = length / segments
    turn = piece * math.sqrt(shape.twist**2 + sum(k * k for k in shape.curvature))
    return _check_sharpness(node, turn, turn / _SHARPEST_JOINT * segments)


def _check_points(node: Node, shape: NaturalShape, length: float, segments: int) -> bool:
    line = np.array(shape.points)
    reached = np.concatenate(([0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))))
    if abs(reached[-1] - length) > _LENGTH_TOLERANCE * length:
        node.report.add(
            node.path + ("points",),
            "must be a line as long as the rod to 5 %, {:g} m, but is {:g} m long: scale the "
            "points, or correct object.length".format(length, reached[-1]),
        )
        return False
    at = np.linspace(0.0, reached[-1], segments + 1)
    ends = np.stack([np.interp(at, reached, column) for column in line.T], axis=1)
    pieces = np.diff(ends, axis=0)
    pieces /= np.linalg.norm(pieces, axis=1)[:, None]
    cosines = np.clip(np.sum(pieces[1:] * pieces[:-1], axis=1), -1.0, 1.0)
    turn = math.hypot(float(np.arccos(cosines).max()), shape.twist * length / segments)
    return _check_sharpness(node, turn, None)


def _check_sharpness(node: Node, turn: float, enough: Optional[float]) -> bool:
    """Report joints that turn by too much [rad]; ``enough`` segments would not."""
    if turn <= _SHARPEST_JOINT:
        return True
    remedy = (
        "take at least {:d} segments".format(math.ceil(enough))
        if enough is not None
        else "take more segments or a smoother line"
    )
    node.report.add(
        node.path,
        "turns by {:.3g} rad from segment to segment; at most {:g} rad bend and twist as a rod "
        "does: {}".format(turn, _SHARPEST_JOINT, remedy),
    )
    return False
