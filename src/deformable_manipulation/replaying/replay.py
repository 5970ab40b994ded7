"""A simulated object, driven as a recorded one was."""

import math
from dataclasses import dataclass, field
from typing import Dict, Iterator, List, Optional, Sequence, Tuple

import numpy as np

from deformable_manipulation.objects.body import GRAVITY, JOINT_SOLVER, make_body
from deformable_manipulation.objects.fabric import FabricSpec
from deformable_manipulation.objects.rod import RodSpec
from deformable_manipulation.objects.spec import ObjectSpec
from deformable_manipulation.replaying.driven_fabric import DrivenFabric
from deformable_manipulation.replaying.driven_rod import DrivenRod
from deformable_manipulation.replaying.grips import Grip
from deformable_manipulation.replaying.measured_shapes import MeasuredShapes, MeasuredShapesError

_USUAL_STEP = 0.01  # s
_FRAMES_OF_VELOCITY = 5
_LONGEST_STEP = 0.1  # s, of one call: in between, the command can be interrupted
_LONGEST_GAP = 60.0  # s, between two shapes


@dataclass(frozen=True)
class ReplayOptions:
    """How a recording is replayed.

    Attributes:
        held: for each gripper the points that it holds; None: the first two and the last two of
            a rod.
        start: ``measured``, in the first shape with its velocities; ``settled``, at rest between
            the grips.
        gravity: (3,) m/s^2.
        solver: of the joints.
        substeps: per 10 ms; None: as many as suit the object.
        aim: for each gripper the angles (2,) [rad] at which it holds a rod.
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

    def __init__(self, spec: ObjectSpec, shapes: MeasuredShapes, options: ReplayOptions):
        self.shapes = shapes
        self.options = options
        _check(shapes, options)
        self._driven = _driven(spec, shapes, options.held or ())
        self.held = self._driven.held
        self.grips = self._driven.grips
        _check_aim(spec, self.held, options)
        self._start = self._first_state()

    def run(self, spec: ObjectSpec, aim: Optional[Sequence[Sequence[float]]] = None) -> np.ndarray:
        """Where the measured points should have been (T, M, 3) [m]; see :meth:`run_whole`."""
        return self.measured(self.run_whole(spec, aim))

    def measured(self, whole: np.ndarray) -> np.ndarray:
        """The measured points (T, M, 3) [m] of what :meth:`run_whole` gives."""
        return np.array([self._driven.measured(points) for points in whole])

    def run_whole(
        self, spec: ObjectSpec, aim: Optional[Sequence[Sequence[float]]] = None
    ) -> np.ndarray:
        """Where the object should have been.

        Args:
            spec: of the same size and number of particles.
            aim: in place of that of the options.

        Returns:
            All points (T, P, 3) [m] of the simulated object.
        """
        grips = self._aimed(self.options.aim if aim is None else aim)
        usual = self._usual_substeps(spec)
        body = make_body(spec, self.options.gravity, self.options.solver)
        for grip in grips:
            body.hold(grip.particle, grip.hold, grip.positions[0], grip.orientations[0])
        body.set_state(*self._start)
        if self.options.start == "settled":
            body.settle(_USUAL_STEP, usual)
        whole = [body.points()[0].copy()]
        for frame, step in enumerate(np.diff(self.shapes.time), start=1):
            for grip in grips:
                body.move_to(grip.particle, grip.positions[frame], grip.orientations[frame], step)
            pieces = max(1, math.ceil(step / _LONGEST_STEP - 1e-6))
            for _ in range(pieces):
                body.step(step / pieces, _substeps(usual, step / pieces))
            whole.append(body.points()[0].copy())
        return np.array(whole)

    def _usual_substeps(self, spec: ObjectSpec) -> int:
        return self.options.substeps or spec.substeps(_USUAL_STEP)

    def softness(self, spec: ObjectSpec) -> str:
        """What the substeps cannot keep of the material, as sentences."""
        body = make_body(spec, self.options.gravity, self.options.solver)
        step = float(np.median(np.diff(self.shapes.time)))
        return body.softness(step, _substeps(self._usual_substeps(spec), step))

    def _aimed(self, aim) -> List[Grip]:
        return [grip.aimed(angles) for grip, angles in zip(self.grips, aim)] if aim else self.grips

    def _first_state(self) -> Tuple[np.ndarray, np.ndarray]:
        """Points (P, 3) [m] of the object and their velocities [m/s], as the measured ones tell."""
        points = self.shapes.without_gaps()[:_FRAMES_OF_VELOCITY]
        time = self.shapes.time[: len(points)] - self.shapes.time[0]
        slopes = np.polyfit(time, points.reshape(len(points), -1), 1)[0]
        velocities = slopes.reshape(points[0].shape)
        return self._driven.spread(points[0]), self._driven.spread(velocities)


def _driven(spec: ObjectSpec, shapes: MeasuredShapes, held: Sequence[Tuple[int, ...]]):
    if isinstance(spec, RodSpec):
        return DrivenRod(spec, shapes, held)
    assert isinstance(spec, FabricSpec)
    return DrivenFabric(spec, shapes, held)


def _substeps(usual: int, step: float) -> int:
    """Substeps in a step [s] between two recorded shapes, from those in 10 ms."""
    return max(1, math.ceil(step / _USUAL_STEP * usual - 1e-6))


def _check(shapes: MeasuredShapes, options: ReplayOptions) -> None:
    mistakes = list(_held_mistakes(options.held or (), len(shapes.places)))
    gaps = np.diff(shapes.time)
    if len(gaps) and gaps.max() > _LONGEST_GAP:
        before = int(gaps.argmax())
        mistakes.append(
            f"nothing was measured from {shapes.time[before]:g} to {shapes.time[before + 1]:g} s; "
            f"a gap is at most {_LONGEST_GAP:g} s long: cut the recording in two there"
        )
    if mistakes:
        raise MeasuredShapesError("\n".join(mistakes))


def _check_aim(spec: ObjectSpec, held: Sequence[Tuple[int, ...]], options: ReplayOptions) -> None:
    if options.aim and not isinstance(spec, RodSpec):
        raise MeasuredShapesError("aims are given, but a gripper pins a fabric: leave out --aim")
    if options.aim and len(options.aim) != len(held):
        raise MeasuredShapesError(
            f"{len(held)} grippers hold it, but {len(options.aim)} aims are given"
        )


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
