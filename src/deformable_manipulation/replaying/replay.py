"""A simulated rod, driven as a recorded one was."""

import math
from dataclasses import dataclass, field
from typing import Dict, Iterator, List, Optional, Sequence, Tuple

import numpy as np
from scipy.interpolate import CubicSpline

from deformable_manipulation.objects.body import GRAVITY, JOINT_SOLVER, make_body
from deformable_manipulation.objects.rod import RodSpec
from deformable_manipulation.replaying.grips import Grip, grips_of
from deformable_manipulation.replaying.measured_shapes import MeasuredShapes, MeasuredShapesError

_USUAL_STEP = 0.01  # s
_FRAMES_OF_VELOCITY = 5
_LENGTH_TOLERANCE = 1.001
_LONGEST_STEP = 0.1  # s, of one call: in between, the command can be interrupted
_LONGEST_GAP = 60.0  # s, between two shapes


@dataclass(frozen=True)
class ReplayOptions:
    """How a recording is replayed.

    Attributes:
        held: for each gripper the points that it holds; None: the first two and the last two.
        start: ``measured``, in the first shape with its velocities; ``settled``, at rest between
            the grips.
        gravity: (3,) m/s^2.
        solver: of the joints.
        substeps: per 10 ms; None: as many as suit the object.
        aim: for each gripper the angles (2,) [rad] at which it holds the object.
    """

    held: Optional[Sequence[Tuple[int, ...]]] = None
    start: str = "measured"
    gravity: Sequence[float] = GRAVITY
    solver: str = JOINT_SOLVER
    substeps: Optional[int] = None
    aim: Sequence[Sequence[float]] = field(default_factory=tuple)


class Replay:
    """A recording prepared for being replayed with any material.

    Raises:
        MeasuredShapesError: the recording does not fit the object.
    """

    def __init__(self, spec: RodSpec, shapes: MeasuredShapes, options: ReplayOptions):
        self.shapes = shapes
        self.options = options
        _check(spec, shapes, options)
        self.held = options.held or default_held(len(shapes.arc_lengths))
        try:
            self.grips = grips_of(shapes, self.held, spec)
        except ValueError as error:
            raise MeasuredShapesError(str(error)) from error
        self._ends = np.array(spec.arc_lengths)
        self._start = self._first_state()

    def run(self, spec: RodSpec, aim: Optional[Sequence[Sequence[float]]] = None) -> np.ndarray:
        """Where the object should have been.

        Args:
            spec: of the same length and number of segments.
            aim: in place of that of the options.

        Returns:
            The measured points (T, M, 3) [m] as simulated.
        """
        grips = self._aimed(self.options.aim if aim is None else aim)
        body = make_body(spec, self.options.gravity, self.options.solver)
        for grip in grips:
            body.hold(grip.particle, grip.hold, grip.positions[0], grip.orientations[0])
        body.set_state(*self._start)
        if self.options.start == "settled":
            body.settle(_USUAL_STEP, self.substeps(spec, _USUAL_STEP))
        predicted = np.empty_like(self.shapes.points)
        predicted[0] = self._points_of(body)
        for frame, step in enumerate(np.diff(self.shapes.time), start=1):
            for grip in grips:
                body.move_to(grip.particle, grip.positions[frame], grip.orientations[frame], step)
            pieces = max(1, math.ceil(step / _LONGEST_STEP - 1e-6))
            for _ in range(pieces):
                body.step(step / pieces, self.substeps(spec, step / pieces))
            predicted[frame] = self._points_of(body)
        return predicted

    def substeps(self, spec: RodSpec, step: float) -> int:
        """Substeps in a step [s] between two recorded shapes."""
        usual = self.options.substeps or spec.substeps(_USUAL_STEP)
        return max(1, math.ceil(step / _USUAL_STEP * usual - 1e-6))

    def softness(self, spec: RodSpec) -> str:
        """What the substeps cannot keep of the material, as sentences."""
        body = make_body(spec, self.options.gravity, self.options.solver)
        step = float(np.median(np.diff(self.shapes.time)))
        return body.softness(step, self.substeps(spec, step))

    def _aimed(self, aim) -> List[Grip]:
        return [grip.aimed(angles) for grip, angles in zip(self.grips, aim)] if aim else self.grips

    def _first_state(self) -> Tuple[np.ndarray, np.ndarray]:
        """Ends of the segments (N + 1, 3) [m] and their velocities [m/s], by splines."""
        points = self.shapes.without_gaps()[:_FRAMES_OF_VELOCITY]
        time = self.shapes.time[: len(points)] - self.shapes.time[0]
        slopes = np.polyfit(time, points.reshape(len(points), -1), 1)[0]
        velocities = slopes.reshape(points[0].shape)
        return self._along(points[0]), self._along(velocities)

    def _along(self, values: np.ndarray) -> np.ndarray:
        """Values (M, 3) at the measured points, taken to the ends of the segments."""
        if len(values) == 2:  # a straight line, beyond both points, too
            first, last = self.shapes.arc_lengths
            return values[0] + np.outer(
                (self._ends - first) / (last - first), values[1] - values[0]
            )
        spline = CubicSpline(self.shapes.arc_lengths, values, bc_type="natural")
        inside = np.clip(self._ends, *self.shapes.arc_lengths[[0, -1]])
        return spline(inside) + (self._ends - inside)[:, None] * spline(inside, 1)

    def _points_of(self, body) -> np.ndarray:
        ends = body.points()[0]
        arc_lengths = self.shapes.arc_lengths
        return np.stack([np.interp(arc_lengths, self._ends, line) for line in ends.T], axis=1)


def default_held(points: int) -> List[Tuple[int, ...]]:
    """A gripper at each end holds two points."""
    return [(0, 1), (points - 2, points - 1)]


def _check(spec: RodSpec, shapes: MeasuredShapes, options: ReplayOptions) -> None:
    mistakes = []
    last = shapes.arc_lengths[-1]
    if last > _LENGTH_TOLERANCE * spec.length:
        mistakes.append(
            f"the last point is at {last:g} m, but the object is {spec.length:g} m long: "
            "correct object.length or the arc lengths"
        )
    count = len(shapes.arc_lengths)
    if options.held is None and count < 5:
        mistakes.append(
            f"has {count} points: the default, that grippers hold the first two and the last two, "
            "needs five; say which are held"
        )
    held = options.held or default_held(count)
    if options.aim and len(options.aim) != len(held):
        mistakes.append(f"{len(held)} grippers hold it, but {len(options.aim)} aims are given")
    mistakes += _held_mistakes(options.held or (), count)
    gaps = np.diff(shapes.time)
    if len(gaps) and gaps.max() > _LONGEST_GAP:
        before = int(gaps.argmax())
        mistakes.append(
            f"nothing was measured from {shapes.time[before]:g} to {shapes.time[before + 1]:g} s; "
            f"a gap is at most {_LONGEST_GAP:g} s long: cut the recording in two there"
        )
    if mistakes:
        raise MeasuredShapesError("\n".join(mistakes))


def _held_mistakes(held: Sequence[Tuple[int, ...]], count: int) -> Iterator[str]:
    holders: Dict[int, int] = {}
    for gripper, numbers in enumerate(held, start=1):
        if numbers[-1] >= count:
            yield f"point {numbers[-1]} cannot be held: there are points 0 to {count - 1}"
        for number in numbers:
            if number in holders:
                yield (
                    f"point {number} is held by grippers {holders[number]} and {gripper} (--held): "
                    "a point belongs to one gripper; leave it out of one of them"
                )
            holders.setdefault(number, gripper)
