"""Which points are of the object and of those who carry it, and no obstacle."""

from typing import Any, Callable, Optional, Tuple

import numpy as np

from deformable_manipulation import _distance
from deformable_manipulation.geometry.pose import Quaternion, Vector
from deformable_manipulation.geometry.rotation import rotate
from deformable_manipulation.obstacles.leave_out import OwnShape
from deformable_manipulation.obstacles.live import LiveObstacle
from deformable_manipulation.scenario.spec import Scenario
from deformable_manipulation.seeing.carried_state import CarriedState

Pose = Tuple[Vector, Quaternion]
# The pose of a tf frame in the fixed frame at a time [s]; None: not known.
FindFrame = Callable[[str, float], Optional[Pose]]


class FrameUnknown(ValueError):
    """The place of a shape that is to be left out is not known; a clause that says which."""


class OwnPoints:
    """Tells points of the object, the grips and the robots' shapes from all others.

    Args:
        scenario: the checked scenario.
        obstacle: whose ``leave_out`` says what is left out.
    """

    def __init__(self, scenario: Scenario, obstacle: LiveObstacle):
        self._spec = obstacle.leave_out
        self._spare = obstacle.size_of_point
        self._margin = scenario.object.margin
        self._faces = scenario.object.faces()
        self._agents = [agent.name for agent in scenario.agents]

    def mark(
        self, points: np.ndarray, state: CarriedState, find_frame: Optional[FindFrame]
    ) -> np.ndarray:
        """Which points (N, 3) [m] of the fixed frame are the robots' own (N,).

        Args:
            points: in the fixed frame.
            state: of the time that they were seen at.
            find_frame: where tf frames were then; None: there is no tf, nor any robot.

        Raises:
            FrameUnknown: a shape's frame is not known.
        """
        elements, reaches = self._elements(state, find_frame)
        if not len(reaches):
            return np.zeros(len(points), dtype=bool)
        return _distance.near_elements(points, elements, reaches + self._spare)

    def _elements(self, state: CarriedState, find_frame: Optional[FindFrame]):
        """Triangles, segments and points (E, 3, 3) [m], and the reach (E,) [m] of each."""
        spec, elements, reaches = self._spec, [], []
        if spec.object > 0.0:
            elements.append(_elements_of(state.points, self._faces))
            reaches.append(np.full(len(elements[0]), self._margin + spec.object))
        if spec.grips > 0.0:
            elements.append(np.repeat(state.positions[:, None], 3, axis=1))
            reaches.append(np.full(len(state.positions), spec.grips))
        for shape in spec.shapes:
            if find_frame is not None or shape.frame in self._agents:
                start, end = self._ends(shape, state, find_frame)
                elements.append(np.array([(start, end, end)]))
                reaches.append(np.array([shape.radius]))
        if not elements:
            return np.empty((0, 3, 3)), np.empty(0)
        return np.concatenate(elements), np.concatenate(reaches)

    def _ends(self, shape: OwnShape, state: CarriedState, find_frame: Any):
        if shape.frame in self._agents:
            index = self._agents.index(shape.frame)
            position = state.positions[index].tolist()
            rotation = tuple(state.orientations[index].tolist())
        else:
            found = find_frame(shape.frame, state.time)
            if found is None:
                raise FrameUnknown(
                    f"the frame '{shape.frame}' of a shape to be left out is not known at its time"
                )
            position, rotation = found
        return [np.add(position, rotate(rotation, end)) for end in (shape.start, shape.end)]


def _elements_of(points: np.ndarray, faces: Optional[np.ndarray]) -> np.ndarray:
    if faces is not None:
        return points[faces]
    return np.stack((points[:-1], points[1:], points[1:]), axis=1)
