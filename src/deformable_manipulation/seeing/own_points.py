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


_MOST_DEVIATIONS = 5.0  # of the noise, that an own point may be off


class FrameUnknown(ValueError):
    """The place of a shape that is to be left out is not known; a clause that says which."""


class OwnPoints:
    """Tells points of the object, the grips and the robots' shapes from all others.

    What is seen by a camera with noise may be nearer to the camera, or farther away. Its points are
    own ones, too, if they may be within reach. Only of the object they must not be farther away
    than what the controllers keep off: there it would hide what they are to keep it off.

    Args:
        scenario: the checked scenario.
        obstacle: whose ``leave_out`` says what is left out.
    """

    def __init__(self, scenario: Scenario, obstacle: LiveObstacle):
        self._spec = obstacle.leave_out
        self._spare = obstacle.size_of_point
        self._doubt = _MOST_DEVIATIONS * obstacle.noise
        self._margin = scenario.object.margin
        self._offset = scenario.controller.collision.offset
        self._faces = scenario.object.faces()
        self._agents = [agent.name for agent in scenario.agents]

    def mark(
        self,
        points: np.ndarray,
        camera: Vector,
        state: CarriedState,
        find_frame: Optional[FindFrame],
    ) -> np.ndarray:
        """Which points (N, 3) [m] of the fixed frame are the robots' own (N,).

        Args:
            points: in the fixed frame.
            camera: [m] where they were seen from.
            state: of the time that they were seen at.
            find_frame: where tf frames were then; None: there is no tf, nor any robot.

        Raises:
            FrameUnknown: a shape's frame is not known.
        """
        elements, reaches, farthest = self._elements(state, find_frame)
        if not len(reaches):
            return np.zeros(len(points), dtype=bool)
        return _distance.near_elements(
            points, elements, reaches + self._spare, farthest + self._spare, camera, self._doubt
        )

    def _elements(self, state: CarriedState, find_frame: Optional[FindFrame]):
        """Triangles, segments and points (E, 3, 3) [m], and (E,) [m] of each.

        First the reach, then how far away a point may be that might be within it.
        """
        spec, elements, reaches = self._spec, [np.empty((0, 3, 3))], []
        if spec.object > 0.0:
            elements.append(_elements_of(state.points, self._faces))
            reaches += [(self._margin + spec.object, self._margin + max(spec.object, self._offset))]
            reaches *= len(elements[-1])
        if spec.grips > 0.0:
            elements.append(np.repeat(state.positions[:, None], 3, axis=1))
            reaches += [(spec.grips, np.inf)] * len(state.positions)
        for shape in spec.shapes:
            if find_frame is not None or shape.frame in self._agents:
                start, end = self._ends(shape, state, find_frame)
                elements.append(np.array([(start, end, end)]))
                reaches.append((shape.radius, np.inf))
        return (np.concatenate(elements), *np.array(reaches).reshape(-1, 2).T)

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
