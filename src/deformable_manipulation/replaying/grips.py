"""How grippers held a measured object: poses of held particles from points that they hold."""

from dataclasses import dataclass
from typing import List, Sequence, Tuple

import numpy as np
from scipy.spatial.transform import Rotation

from deformable_manipulation.objects.rod import RodSpec
from deformable_manipulation.replaying.measured_shapes import MeasuredShapes, MeasuredShapesError


@dataclass(frozen=True)
class Grip:
    """A gripper's motion.

    Attributes:
        particle: the segment that it holds.
        hold: ``clamped``, or ``pinned`` where a single point tells nothing of the direction.
        positions: (T, 3) m, of the segment's centre.
        orientations: (T, 4) quaternions x, y, z, w.
    """

    particle: int
    hold: str
    positions: np.ndarray
    orientations: np.ndarray

    def aimed(self, angles: Sequence[float]) -> "Grip":
        """The same with the object held at angles (2,) [rad] about the grip's own y and z axes."""
        turn = Rotation.from_rotvec((0.0, *angles))
        turned = Rotation.from_quat(self.orientations) * turn
        return Grip(self.particle, self.hold, self.positions, turned.as_quat())


def grips_of(shapes: MeasuredShapes, held: Sequence[Sequence[int]], spec: RodSpec) -> List[Grip]:
    """The motion of each gripper, untwisted along the first shape.

    Args:
        held: for each gripper the points that it holds, in their order; one: it pins that point.
        spec: the object.

    Raises:
        MeasuredShapesError: a held point was never seen, or points are at the same place.
        ValueError: two grippers hold the same segment.
    """
    points = shapes.without_gaps()
    _require_apart(points[0])
    frames = _frames_along(points[0])
    grips = []
    for numbers in held:
        first, last = numbers[0], numbers[-1]
        centre = 0.5 * (shapes.places[first] + shapes.places[last])
        particle = spec.segment_at(centre)
        if any(grip.particle == particle for grip in grips):
            raise ValueError(f"two grippers hold segment {particle}: use more segments")
        if first == last:
            still = np.tile(frames[min(first, len(frames) - 1)].as_quat(), (len(points), 1))
            grips.append(Grip(particle, "pinned", points[:, first], still))
            continue
        tangents = points[:, last] - points[:, first]
        lengths = np.linalg.norm(tangents, axis=1, keepdims=True)
        if not lengths.all():
            time = shapes.time[int(lengths.argmin())]
            raise MeasuredShapesError(
                f"points {first} and {last} of a gripper are at the same place at {time:g} s"
            )
        tangents /= lengths
        beyond = spec.centre(particle) - shapes.places[first]
        positions = points[:, first] + beyond * tangents
        orientations = _carried(frames[first], tangents)
        grips.append(Grip(particle, "clamped", positions, orientations))
    return grips


def _require_apart(points: np.ndarray) -> None:
    same = np.flatnonzero((np.diff(points, axis=0) == 0.0).all(axis=1))
    if same.size:
        raise MeasuredShapesError(
            f"points {same[0]} and {same[0] + 1} are at the same place in the first shape"
        )


def _smallest_turn(start: np.ndarray, end: np.ndarray) -> Rotation:
    """The smallest rotation from one unit vector to another."""
    axis = np.cross(start, end)
    sine = np.linalg.norm(axis)
    if sine < 1e-12:
        return Rotation.identity()
    return Rotation.from_rotvec(np.arctan2(sine, start @ end) / sine * axis)


def _frames_along(points: np.ndarray) -> List[Rotation]:
    """Frames between points (M, 3), x along the object, without twist from one to the next."""
    directions = np.diff(points, axis=0)
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    frames, before = [], np.array((1.0, 0.0, 0.0))
    frame = Rotation.identity()
    for direction in directions:
        frame = _smallest_turn(before, direction) * frame
        frames.append(frame)
        before = direction
    return frames


def _carried(frame: Rotation, tangents: np.ndarray) -> np.ndarray:
    """Quaternions (T, 4) of a frame that follows tangents (T, 3) without spinning about them."""
    quaternions = []
    before = frame.apply((1.0, 0.0, 0.0))
    for tangent in tangents:
        frame = _smallest_turn(before, tangent) * frame
        quaternions.append(frame.as_quat())
        before = tangent
    return np.array(quaternions)


def parse_held(text: str) -> Tuple[int, ...]:
    """Numbers of points that one gripper holds, as in ``0,1``. Raises ValueError."""
    numbers = tuple(int(item) for item in text.split(","))
    if list(numbers) != sorted(set(numbers)) or numbers[0] < 0:
        raise ValueError
    return numbers
