"""Minimum distance between a rod or rope and planar obstacles."""

import math

import numpy as np

from deformable_manipulation.distance.features import Distances
from deformable_manipulation.distance.planar_obstacle import PlanarObstacle
from deformable_manipulation.distance.planes import PLANE_AXES
from deformable_manipulation.distance.polygons import PolygonError
from deformable_manipulation.distance.selection import SELECTIONS

_UNIT_TOLERANCE = 1e-6
_ROUNDING = 1e-12  # m
_ENDS = np.array((0, 1, 1))  # a segment's geometry points; the third one's weight is 0


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

    The result depends on the points alone (to rounding), not on calls before. One instance must
    not be used by several threads at a time: it keeps the edges near the last points.

    Args:
        obstacles: sequence of scenario.spec.PolygonObstacle.
        radius: of the object, subtracted from all distances [m], >= 0.
        band: [m], >= 0.
        features: "local" or "segments".

    Raises ValueError, with all mistakes at once.
    """

    def __init__(self, obstacles, radius, band=0.1, features="local"):
        problems = _length_problems(radius=radius, band=band)
        if features not in SELECTIONS:
            problems.append(
                "features is {!r}; allowed are {}".format(features, _quoted(SELECTIONS))
            )
        self._obstacles = []
        for spec in obstacles:
            faults = _pose_problems(spec)
            if not faults:
                try:
                    self._obstacles.append(PlanarObstacle(spec))
                except PolygonError as error:
                    faults = [str(error)]
            problems += ["obstacle {!r}: {}".format(spec.name, fault) for fault in faults]
        if problems:
            raise ValueError("\n".join(problems))
        self._radius = float(radius)
        self._band = float(band)
        self._select = SELECTIONS[features]
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
        if not np.isfinite(points).all():
            copy, point, _ = np.argwhere(~np.isfinite(points))[0]
            raise ValueError(
                "point {} of copy {} is {}; points must be finite".format(
                    point, copy, points[copy, point]
                )
            )
        if not self._obstacles:
            return _nothing_near(len(points))
        rows = [self._rows_of(index, points) for index in range(len(self._obstacles))]
        rows = rows[0] if len(rows) == 1 else [np.concatenate(parts) for parts in zip(*rows)]
        return self._assemble(len(points), *rows)

    def _rows_of(self, index, points):
        """The features of one obstacle: copy, obstacle (M,), and the per-feature fields."""
        obstacle = self._obstacles[index]
        approach = obstacle.approach(points, self._band)
        segment, parameter = self._select(approach)
        segment = np.concatenate((segment, approach.segment[1:]))
        parameter = np.concatenate((parameter, approach.parameter[1:]))
        copies = len(points)
        copy = np.maximum(np.arange(copies - len(segment), copies), 0)  # 0, ..., 0, 1, 2, ...
        start = points[copy, segment]
        object_point = start + parameter[:, None] * (points[copy, segment + 1] - start)
        weights = np.zeros((len(segment), 3))
        weights[:, 0] = 1.0 - parameter
        weights[:, 1] = parameter
        nearest = obstacle.nearest(object_point, approach.touching[copy])
        return (
            copy,
            np.full(len(segment), index),
            nearest.distance - self._radius,
            object_point,
            object_point + nearest.offset,
            nearest.normal,
            segment[:, None] + _ENDS,
            weights,
        )

    def _assemble(self, copies, copy, *fields):
        """Distances of the rows within the band of their copy's minimum, the nearest first."""
        distance = fields[1]
        order = np.lexsort((distance, copy))
        copy, distance = copy[order], distance[order]
        starts = np.searchsorted(copy, np.arange(copies))
        kept = distance <= distance[0] + self._band + _ROUNDING
        kept &= copy == 0
        kept[starts] = True
        order = order[kept]
        obstacle, distance, *others = (field[order] for field in fields)
        object_point, obstacle_point, normal, vertices, weights = others
        offsets = np.searchsorted(copy[kept], np.arange(copies + 1))
        return Distances(
            minimum=distance[offsets[:-1]],
            offsets=offsets,
            distance=distance,
            obstacle=obstacle,
            object_point=object_point,
            obstacle_point=obstacle_point,
            normal=normal,
            vertices=vertices,
            weights=weights,
            obstacle_velocity=np.zeros(normal.shape),
            names=self._names,
        )


def _nothing_near(copies):
    """Distances of copies when there is no obstacle."""
    vectors = np.zeros((0, 3))
    return Distances(
        minimum=np.full(copies, np.inf),
        offsets=np.zeros(copies + 1, dtype=int),
        distance=np.zeros(0),
        obstacle=np.zeros(0, dtype=int),
        object_point=vectors,
        obstacle_point=vectors,
        normal=vectors,
        vertices=np.zeros((0, 3), dtype=int),
        weights=vectors,
        obstacle_velocity=vectors,
    )


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
