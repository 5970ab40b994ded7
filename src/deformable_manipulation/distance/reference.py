"""Minimum distances by Trimesh, FCL and Shapely: slow, and independent of the C++ core."""

import dataclasses

import numpy as np

from deformable_manipulation.distance.features import Distances
from deformable_manipulation.distance.minimum_distance import (
    checked_points,
    named,
    setting_problems,
)
from deformable_manipulation.distance.reference_shapes import reference_shape

# Points of a triangle, as weights of its corners, that an object's depth is sampled at.
_SUBDIVISIONS = 8
_GRID = np.array(
    [
        (i, j, _SUBDIVISIONS - i - j)
        for i in range(_SUBDIVISIONS + 1)
        for j in range(_SUBDIVISIONS + 1 - i)
    ]
) / float(_SUBDIVISIONS)


class ReferenceMinimumDistance:
    """The same as :class:`~.minimum_distance.MinimumDistance`, as far as the libraries can.

    Outside, distances are those of FCL (meshes) and Shapely (polygons). An element that reaches
    inside has minus the depth of the deepest of some points on it, so depths are too small by up to
    an eighth of its longest side. Meshes that Trimesh does not call watertight have no sign; the
    components of a mesh are taken as one surface.

    Arguments and errors are those of MinimumDistance.
    """

    def __init__(self, obstacles, margin, band=0.1, triangles=None):
        problems = setting_problems(obstacles, margin, band, triangles)
        self._shapes = []
        if not problems:
            for spec in obstacles:
                try:
                    self._shapes.append(reference_shape(spec))
                except ValueError as error:
                    problems += named(spec, str(error).splitlines())
        if problems:
            raise ValueError("\n".join(problems))
        self._obstacles = list(obstacles)
        self._velocities = [(np.zeros(3), np.zeros(3))] * len(self._obstacles)
        self._margin, self._band = margin, band
        self._triangles = None if triangles is None else np.asarray(triangles)
        self.names = tuple(spec.name for spec in obstacles)
        self.warnings = ()

    def set_pose(self, index, pose):
        """Move an obstacle; see MinimumDistance. Its shape is made again."""
        spec = dataclasses.replace(
            self._obstacles[index], translation=pose.translation, rotation=pose.rotation
        )
        problems = list(spec.problems())
        if problems:
            raise ValueError("\n".join(named(spec, problems)))
        self._obstacles[index] = spec
        self._shapes[index] = reference_shape(spec)
        self._velocities[index] = np.array(pose.linear), np.array(pose.angular)

    def compute(self, points):
        """Distances (features.Distances) of points (C, P, 3) [m]. Raises ValueError."""
        points = checked_points(points)
        if not np.isfinite(points).all():
            raise ValueError("points are not all finite")
        elements = self._elements(points.shape[1])
        rows, minimum, offsets = [], [], [0]
        for copy, geometry in enumerate(points):
            found = self._features(geometry, elements)
            minimum.append(found[0].distance if found else np.inf)
            if copy == 0:
                limit = minimum[0] + self._band
                rows += [row for row in found if row.distance <= limit]
            else:
                rows += found[:1]
            offsets.append(len(rows))
        return self._distances(rows, minimum, offsets, points.shape[1])

    def _elements(self, count):
        if self._triangles is not None:
            if self._triangles.min() < 0 or self._triangles.max() >= count:
                raise ValueError("triangles refer to points from 0 to {}".format(count - 1))
            return self._triangles
        return np.array([(i, i + 1, i + 1) for i in range(count - 1)])

    def _features(self, geometry, elements):
        """Rows of one copy, the nearest first."""
        found = []
        for index, shape in enumerate(self._shapes):
            rows = [
                _Row(index, vertices, self._nearest(shape, geometry[vertices]), shape, geometry)
                for vertices in elements
            ]
            found += rows
        return sorted(found, key=lambda row: row.distance)

    @staticmethod
    def _nearest(shape, corners):
        """Distance [m] of an element, and the weights (3,) of its corners there."""
        is_segment = (corners[1] == corners[2]).all()
        grid = _GRID[_GRID[:, 2] == 0.0] if is_segment else _GRID
        distance, weights = shape.nearest(corners)
        if shape.reaches_inside(corners, distance):
            depths = shape.signed(grid @ corners)
            deepest = int(np.argmin(depths))
            if depths[deepest] < 0.0:
                return float(depths[deepest]), grid[deepest]
        return distance, weights

    def _distances(self, rows, minimum, offsets, count):
        def stacked(values, width=(3,), dtype=float):
            return np.array(values, dtype=dtype).reshape((len(rows),) + width)

        vertices = stacked([row.vertices for row in rows], dtype=int)
        obstacle = stacked([row.obstacle for row in rows], (), int)
        identity = obstacle
        for column in range(1 if self._triangles is None else 3):
            identity = identity * count + vertices[:, column]
        return Distances(
            minimum=np.array(minimum) - self._margin,
            offsets=np.array(offsets),
            distance=stacked([row.distance for row in rows], ()) - self._margin,
            obstacle=obstacle,
            object_point=stacked([row.object_point for row in rows]),
            obstacle_point=stacked([row.obstacle_point for row in rows]),
            normal=stacked([row.normal for row in rows]),
            vertices=vertices,
            weights=stacked([row.weights for row in rows]),
            obstacle_velocity=stacked([self._velocity(row) for row in rows]),
            identity=identity,
            names=self.names,
        )

    def _velocity(self, row):
        """Of the obstacle at its point [m/s]."""
        linear, angular = self._velocities[row.obstacle]
        arm = row.obstacle_point - np.asarray(self._obstacles[row.obstacle].translation)
        return linear + np.cross(angular, arm)


class _Row:
    """One feature."""

    def __init__(self, obstacle, vertices, nearest, shape, geometry):
        self.obstacle, self.vertices = obstacle, vertices
        self.distance, self.weights = nearest
        self._shape, self._geometry = shape, geometry

    @property
    def object_point(self):
        return self.weights @ self._geometry[self.vertices]

    @property
    def obstacle_point(self):
        return self._shape.foot(self.object_point)

    @property
    def normal(self):
        arm = self.object_point - self.obstacle_point
        length = np.linalg.norm(arm)
        if length == 0.0:
            return self._shape.normal(self.object_point)
        return np.copysign(1.0, self.distance) * arm / length
