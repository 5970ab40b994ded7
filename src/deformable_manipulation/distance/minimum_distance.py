"""Minimum distances between all copies of an object and obstacles."""

import math

import numpy as np

from deformable_manipulation import _distance


class MinimumDistance:
    """Signed distances of a polyline or a surface with a margin to obstacles.

    The distance of an object is the least signed distance of all its points, those within segments
    and triangles included, minus the margin. A point's signed distance to an obstacle is its
    distance to the boundary, negative inside. Polygons are endless along a normal; a mesh has an
    inside where it is closed (docs/mathematics.md). Obstacles count one by one: where two overlap,
    the depth is that in one of them, not in their union.

    Features of copy 0, the object itself, are the nearest points of each segment or triangle to
    every obstacle, up to ``band`` farther than its minimum. Rows of a barrier for each of them do
    not jump when the object turns along an edge. Every other copy has one feature, its minimum.
    Within a segment the nearest points' weights are those of its two ends. A normal points from the
    obstacle to the object, inside from the object to the nearest point of the boundary; on the
    boundary it is the outward normal.

    The result depends on the points alone, not on calls before.
    One instance must not be used by several threads at a time: it remembers what was nearest.

    Args:
        obstacles: sequence of obstacles.spec.ObstacleSpec.
        margin: radius or half thickness of the object, subtracted from all distances [m], >= 0.
        band: [m], >= 0.
        triangles: (T, 3) indices of the object's points, T >= 1; None: a polyline through them.

    Raises:
        ValueError: something is wrong; the message has all mistakes at once.
    """

    def __init__(self, obstacles, margin, band=0.1, triangles=None):
        problems = setting_problems(obstacles, margin, band, triangles)
        native, warnings = [], []
        for spec in obstacles:
            if not any(spec.problems()):
                try:
                    obstacle, found = spec.native()
                    obstacle.set_pose(spec.translation, spec.rotation)
                    native.append(obstacle)
                    warnings += named(spec, found)
                except ValueError as error:
                    problems += named(spec, str(error).splitlines())
        if problems:
            raise ValueError("\n".join(problems))
        self._obstacles = native
        self._triangles = None if triangles is None else np.ascontiguousarray(triangles)
        self.names = tuple(spec.name for spec in obstacles)
        self._native = _distance.MinimumDistance(native, margin, band, list(self.names))
        #: Sentences about what was repaired or ignored in the meshes.
        self.warnings = tuple(warnings)

    @property
    def native(self):
        """The C++ core's ``_distance.MinimumDistance``."""
        return self._native

    def set_pose(self, index, pose):
        """Move an obstacle.

        Args:
            index: of the obstacle.
            pose: obstacle_motion.MovingPose; the features include its velocity.

        Raises:
            ValueError: a number is not finite, or the quaternion does not have length 1.
        """
        self._obstacles[index].set_pose(*pose)

    def replace(self, index, obstacle):
        """Put another obstacle of the C++ core in the place of one.

        Args:
            index: of the obstacle.
            obstacle: ``_distance.Obstacle``, at its pose; nobody else may use it.
        """
        self._native.replace(index, obstacle)
        self._obstacles[index] = obstacle

    def compute(self, points):
        """Distances of C copies of the object.

        Args:
            points: (C, P, 3) of the fixed frame [m], P >= 2.

        Returns:
            features.Distances.

        Raises:
            ValueError: the shape is wrong, a point is not finite, or a triangle refers to a point
                that does not exist.
        """
        return self._native.compute(checked_points(points), self._triangles)


def checked_points(points):
    """The points as an array of numbers. Raises ValueError if the shape is wrong."""
    points = np.asarray(points, dtype=float)
    if points.ndim != 3 or points.shape[0] < 1 or points.shape[1] < 2 or points.shape[2] != 3:
        raise ValueError(
            "points have the shape {}; it must be (copies >= 1, points >= 2, 3)".format(
                points.shape
            )
        )
    return points


def setting_problems(obstacles, margin, band, triangles):
    """What is wrong with the arguments of a MinimumDistance, but for the obstacles' shapes."""
    problems = [
        "{} is {!r}; it must be a finite number of metres, 0 or more".format(key, value)
        for key, value in (("margin", margin), ("band", band))
        if not (_is_number(value) and value >= 0.0)
    ]
    if triangles is not None:
        given = np.asarray(triangles)
        if given.dtype.kind not in "iu" or given.ndim != 2 or not len(given) or given.shape[1] != 3:
            problems.append(
                "triangles must be whole numbers of the shape (triangles >= 1, 3), or None for a "
                "polyline"
            )
    for spec in obstacles:
        problems += named(spec, spec.problems())
    return problems


def named(spec, faults):
    """Faults or warnings of an obstacle, with its name."""
    return ["obstacle {!r}: {}".format(spec.name, fault) for fault in faults]


def _is_number(value):
    return isinstance(value, (int, float, np.number)) and math.isfinite(value)
