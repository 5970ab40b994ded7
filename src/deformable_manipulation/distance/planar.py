"""Minimum distance between a rod or rope and planar obstacles."""

import math

import numpy as np

from deformable_manipulation import _distance
from deformable_manipulation.distance.features import Distances
from deformable_manipulation.distance.planes import PLANE_AXES
from deformable_manipulation.distance.polygons import check_ring

_SELECTIONS = {"local": "local", "segments": "elements"}  # by their names in the C++ core
_UNIT_TOLERANCE = 1e-6


class PlanarMinimumDistance:
    """Signed distances of polylines with a radius to polygons that are endless along a normal.

    The distance of a polyline is the least signed distance of all its points, segments included,
    minus the radius. A point's signed distance to an obstacle is its distance to the boundary,
    negative inside. Obstacles count one by one: where two overlap, the depth is that in one of
    them, not in their union.

    Features of copy 0, the object itself, up to ``band`` farther than its minimum, of every
    obstacle:

    - ``features="local"``: the local minima of the signed distance along the object. A stretch
      level with an edge counts once, by its middle.
    - ``features="segments"``: the nearest point of each segment. Rows of a barrier for each of
      them do not jump when the object turns along an edge.

    Every other copy has one feature, its minimum. Within a segment the nearest points' weights are
    those of its two ends. A normal points from the obstacle to the object, inside from the object
    to the nearest point of the boundary; on the boundary it is the edge's outward normal.

    The result depends on the points alone, not on calls before. One instance must not be used by
    several threads at a time: it remembers what was nearest.

    Args:
        obstacles: sequence of scenario.spec.PolygonObstacle.
        radius: of the object, subtracted from all distances [m], >= 0.
        band: [m], >= 0.
        features: "local" or "segments".

    Raises ValueError, with all mistakes at once.
    """

    def __init__(self, obstacles, radius, band=0.1, features="local"):
        problems = _length_problems(radius=radius, band=band)
        if features not in _SELECTIONS:
            problems.append(
                "features is {!r}; allowed are {}".format(features, _quoted(_SELECTIONS))
            )
        native = []
        for spec in obstacles:
            faults = _pose_problems(spec)
            if not faults:
                try:
                    native.append(_native_obstacle(spec))
                except ValueError as error:
                    faults = str(error).splitlines()
            problems += ["obstacle {!r}: {}".format(spec.name, fault) for fault in faults]
        if problems:
            raise ValueError("\n".join(problems))
        self._native = _distance.MinimumDistance(native, radius, band, _SELECTIONS[features])
        self._names = tuple(spec.name for spec in obstacles)

    def compute(self, points):
        """Distances of C copies of a polyline.

        Args:
            points: (C, P, 3) of the fixed frame [m], P >= 2.

        Returns:
            features.Distances.

        Raises ValueError where the shape is another or a point is not finite.
        """
        points = np.asarray(points, dtype=float)
        if points.ndim != 3 or points.shape[0] < 1 or points.shape[1] < 2 or points.shape[2] != 3:
            raise ValueError(
                "points have the shape {}; it must be (copies >= 1, points >= 2, 3)".format(
                    points.shape
                )
            )
        return Distances(*self._native.compute(points), self._names)


def _native_obstacle(spec):
    """The C++ core's obstacle. Raises ValueError where the ring bounds no region."""
    ring = check_ring(spec.points)
    return _distance.PlanarObstacle(ring, spec.plane, spec.translation, spec.rotation)


def _length_problems(**lengths):
    return [
        "{} is {!r}; it must be a finite number of metres, 0 or more".format(key, value)
        for key, value in lengths.items()
        if not (_is_number(value) and value >= 0.0)
    ]


def _pose_problems(spec):
    """What is wrong with plane, translation and rotation of a PolygonObstacle."""
    problems = []
    if spec.plane not in PLANE_AXES:
        problems.append("plane is {!r}; allowed are {}".format(spec.plane, _quoted(PLANE_AXES)))
    if len(spec.translation) != 3 or not all(map(_is_number, spec.translation)):
        problems.append(
            "translation is {}; it must be three finite numbers of metres".format(spec.translation)
        )
    if (
        len(spec.rotation) != 4
        or not all(map(_is_number, spec.rotation))
        or abs(math.sqrt(sum(q * q for q in spec.rotation)) - 1.0) > _UNIT_TOLERANCE
    ):
        problems.append(
            "rotation is {}; it must be a quaternion x, y, z, w of length 1".format(spec.rotation)
        )
    return problems


def _is_number(value):
    return isinstance(value, (int, float, np.number)) and math.isfinite(value)


def _quoted(names):
    return ", ".join("'{}'".format(name) for name in names)
