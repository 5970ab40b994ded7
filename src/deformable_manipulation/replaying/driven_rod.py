"""A rod that is driven as a recorded one was."""

from typing import List, Sequence, Tuple

import numpy as np
from scipy.interpolate import CubicSpline

from deformable_manipulation.objects.rod import RodSpec
from deformable_manipulation.replaying.grips import Grip, grips_of
from deformable_manipulation.replaying.measured_shapes import MeasuredShapes, MeasuredShapesError

USUALLY_HELD = ((0, 1), (-2, -1))  # by a gripper at each end: two points, counted from both ends
_LENGTH_TOLERANCE = 1.001


class DrivenRod:
    """Where a rod is held, and how measured points lie on it.

    Args:
        spec: the rod.
        shapes: the recording.
        held: for each gripper the points that it holds; none: the first two and the last two.

    Raises:
        MeasuredShapesError: the recording does not fit the rod.
    """

    def __init__(self, spec: RodSpec, shapes: MeasuredShapes, held: Sequence[Tuple[int, ...]]):
        _check(spec, shapes, held)
        self._places = shapes.places
        count = len(shapes.places)
        self.held = held or [tuple(n % count for n in numbers) for numbers in USUALLY_HELD]
        try:
            self.grips: List[Grip] = grips_of(shapes, self.held, spec)
        except ValueError as error:
            raise MeasuredShapesError(str(error)) from error
        self._ends = np.array(spec.arc_lengths)

    def spread(self, values: np.ndarray) -> np.ndarray:
        """Values (M, 3) at the measured points, taken to the ends of the segments (N + 1, 3)."""
        if len(values) == 2:  # a straight line, beyond both points, too
            first, last = self._places
            return values[0] + np.outer(
                (self._ends - first) / (last - first), values[1] - values[0]
            )
        spline = CubicSpline(self._places, values, bc_type="natural")
        inside = np.clip(self._ends, *self._places[[0, -1]])
        return spline(inside) + (self._ends - inside)[:, None] * spline(inside, 1)

    def measured(self, ends: np.ndarray) -> np.ndarray:
        """The measured points (M, 3) on the segments with these ends (N + 1, 3)."""
        return np.stack([np.interp(self._places, self._ends, line) for line in ends.T], axis=1)


def _check(spec: RodSpec, shapes: MeasuredShapes, held: Sequence[Tuple[int, ...]]) -> None:
    mistakes = []
    if shapes.places.ndim > 1:
        raise MeasuredShapesError(
            "its points are those of a fabric (x@X/Y), but the object is a rod"
        )
    last = shapes.places[-1]
    if last > _LENGTH_TOLERANCE * spec.length:
        mistakes.append(
            f"the last point is at {last:g} m, but the object is {spec.length:g} m long: "
            "correct object.length or the arc lengths"
        )
    count = len(shapes.places)
    if not held and count < 5:
        mistakes.append(
            f"has {count} points: the default, that grippers hold the first two and the last two, "
            "needs five; say which are held"
        )
    if mistakes:
        raise MeasuredShapesError("\n".join(mistakes))
