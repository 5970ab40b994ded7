"""A simulated depth camera: noise, holes, and what is hidden."""

import math
from typing import List, Tuple

import numpy as np

from deformable_manipulation.geometry.pose import Quaternion
from deformable_manipulation.motion.obstacle_motion import ObstaclePath
from deformable_manipulation.obstacles.drawings import Surface
from deformable_manipulation.obstacles.spec import ObstacleSpec, placed
from deformable_manipulation.scenario.spec import PathMotion, PolygonObstacle, Scenario
from deformable_manipulation.seeing.carried_state import CarriedState
from deformable_manipulation.seeing.object_surface import balls, surface_of
from deformable_manipulation.seeing.rendering import Raster

_EDGE = 0.03  # of the depth: neighbours farther apart than this are at the edge of something


class DepthCamera:
    """Takes depth images of a scenario: its obstacles with surfaces, the object, the grips.

    Pixels have no depth out of the camera's range, at the edges of things (a neighbour is farther
    away or nearer by 3 %), and at random. The noise of the depth is normal, with a standard
    deviation that grows with the square of the depth, as of stereo cameras and structured light
    (Khoshelham, Elberink, Accuracy and resolution of Kinect depth data, 2012).

    Args:
        scenario: the checked scenario, with a ``camera``.
    """

    def __init__(self, scenario: Scenario):
        camera = scenario.camera
        if camera is None:
            raise ValueError("the scenario has no camera")
        self._scenario, self._camera = scenario, camera
        self._raster = Raster(camera.width, camera.height, camera.field_of_view)
        self._axes = camera_axes(camera)
        real = [each for each in scenario.obstacles if each.real]
        standing = [each for each in real if not _is_on_path(each)]
        self._moving = [each for each in real if _is_on_path(each)]
        self._background = self._depths([self._triangles(each) for each in standing])

    @property
    def shape(self) -> Tuple[int, int]:
        """Rows and columns of its images."""
        return self._raster.height, self._raster.width

    def image(self, cycle: int, state: CarriedState) -> np.ndarray:
        """The points (H, W, 3) [m] of its image, single precision, in its frame; nan: no depth.

        The same cycle has the same noise.

        Args:
            cycle: of the run.
            state: the object and the agents then.
        """
        body = surface_of(state.points, self._scenario.object)
        grips = balls(state.positions, self._camera.grips)
        time = cycle * self._scenario.cycle_time
        moving = [
            self._triangles(each.at(*ObstaclePath(each).at(time)[:2])) for each in self._moving
        ]
        depths = np.minimum(self._background, self._depths([body, grips, *moving]))
        random = np.random.default_rng([self._camera.seed, cycle])
        return self._noisy(depths.reshape(self.shape), random)

    def _noisy(self, depths: np.ndarray, random: np.random.Generator) -> np.ndarray:
        camera = self._camera
        seen = (depths >= camera.nearest) & (depths <= camera.farthest) & ~_edges(depths)
        seen &= random.random(depths.shape) >= camera.holes
        clean = np.where(seen, depths, np.nan)
        noisy = clean + camera.noise * clean**2 * random.standard_normal(depths.shape)
        points = self._raster.directions.reshape(*depths.shape, 3) * noisy[:, :, None]
        return points.astype(np.float32)

    def _depths(self, surfaces: List[np.ndarray]) -> np.ndarray:
        triangles = np.concatenate([np.empty((0, 3, 3)), *surfaces])
        return self._raster.depths((triangles - self._camera.position) @ self._axes)

    def _triangles(self, obstacle: ObstacleSpec) -> np.ndarray:
        """Corners (T, 3, 3) [m] of its surface; none, if it has none."""
        if isinstance(obstacle, PolygonObstacle):  # endless: as far as the camera sees
            drawing = obstacle.drawing(self._camera.farthest)
        else:
            drawing = obstacle.drawing()
        if not isinstance(drawing, Surface):
            return np.empty((0, 3, 3))
        return placed(obstacle, drawing.triangles)


def camera_axes(camera) -> np.ndarray:
    """Columns: its x axis to the right, y down, z forward, in the fixed frame."""
    forward = np.subtract(camera.target, camera.position)
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, (0.0, 0.0, 1.0))
    right /= np.linalg.norm(right)
    return np.column_stack((right, np.cross(forward, right), forward))


def camera_rotation(camera) -> Quaternion:
    """The camera's orientation in the fixed frame."""
    axes = camera_axes(camera)
    # From the sums and differences of its diagonal, with the signs of its other elements.
    diagonal = axes.diagonal()
    x, y, z = 0.5 * np.sqrt(np.maximum(1.0 + 2.0 * diagonal - diagonal.sum(), 0.0))
    w = 0.5 * math.sqrt(max(1.0 + diagonal.sum(), 0.0))
    turned = axes - axes.T
    x, y, z = (
        math.copysign(x, turned[2, 1]),
        math.copysign(y, turned[0, 2]),
        math.copysign(z, turned[1, 0]),
    )
    norm = math.sqrt(x * x + y * y + z * z + w * w)
    return x / norm, y / norm, z / norm, w / norm


def _is_on_path(obstacle: ObstacleSpec) -> bool:
    return isinstance(obstacle.motion, PathMotion)


def _edges(depths: np.ndarray) -> np.ndarray:
    """Pixels with a neighbour that is much farther away or nearer."""
    edges = np.zeros(depths.shape, dtype=bool)
    for axis in (0, 1):
        before, after = np.moveaxis(depths, axis, 0)[:-1], np.moveaxis(depths, axis, 0)[1:]
        with np.errstate(invalid="ignore"):  # beside a pixel of nothing is one of nothing
            apart = np.abs(after - before) > _EDGE * np.minimum(before, after)
        marked = np.moveaxis(edges, axis, 0)
        marked[:-1] |= apart
        marked[1:] |= apart
    return edges
