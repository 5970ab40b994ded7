"""One planar obstacle: signed distances in its plane, and the points nearest to it."""

import math
from typing import NamedTuple

import numpy as np
import shapely

from deformable_manipulation.distance.approach import Approach
from deformable_manipulation.distance.depth import deepest_points
from deformable_manipulation.distance.planes import PlaneFrame
from deformable_manipulation.distance.polygons import check_ring
from deformable_manipulation.distance.segments import SegmentSet
from deformable_manipulation.distance.selection import PROBE

_SKIN = 0.1  # m, by which the neighbourhood is larger than needed, so that it lasts some cycles
_ON_BOUNDARY = 1e-9  # m, distance below which the direction to the boundary is rounding


class NearestPoints(NamedTuple):
    """Where K given points are nearest to the boundary."""

    distance: np.ndarray  # (K,) m, signed
    offset: np.ndarray  # (K, 3) m, from the given point to the boundary
    normal: np.ndarray  # (K, 3) unit vector along which the signed distance grows fastest


class _Neighbourhood(NamedTuple):
    """The edges that can be the nearest to polylines in a box."""

    edges: SegmentSet
    corners: np.ndarray  # (E, 3) homogeneous, first points of the edges
    lower: np.ndarray  # (2,) m, of the box
    upper: np.ndarray  # (2,) m

    def margin(self, box):
        """By how much another box (lower, upper) may grow without leaving this one [m]."""
        return min(*(box[0] - self.lower).tolist(), *(self.upper - box[1]).tolist())


class PlanarObstacle:
    """A polygon in a plane, endless along the plane's normal.

    Args:
        spec: scenario.spec.PolygonObstacle, its pose finite and its plane known.

    Raises PolygonError if the ring bounds no region.
    """

    def __init__(self, spec):
        ring = np.array(check_ring(spec.points))
        centre = 0.5 * (ring.min(axis=0) + ring.max(axis=0))
        ring -= centre
        if not shapely.LinearRing(ring).is_ccw:
            ring = ring[::-1].copy()
        self._frame = PlaneFrame(spec.plane, spec.translation, spec.rotation, centre)
        self._polygon = shapely.Polygon(ring)
        shapely.prepare(self._polygon)
        self._starts, self._ends = ring, np.roll(ring, -1, axis=0)
        infinite = np.full(2, np.inf)
        self._whole = self._within(-infinite, infinite)
        self._near = self._whole

    def approach(self, points, band):
        """How near polylines (C, P, 3) come: an Approach.

        The first one in detail, as far as it is within ``band`` [m] of its own minimum.
        """
        lines = self._frame.project(points)
        squared = self._vertex_distances(lines, band)
        touching = shapely.intersects(
            self._polygon, shapely.linestrings(np.ascontiguousarray(lines[..., :2]))
        )
        return Approach(self, lines, squared, touching, band)

    def nearest(self, points, touching):
        """NearestPoints of points (K, 3) of the fixed frame.

        Args:
            points: of polylines given to ``approach`` last, within the band.
            touching: (K,) whether the point's polyline touches or enters the polygon.
        """
        flat = self._frame.project(points)
        entered = touching.any()
        edges = self._whole.edges if entered else self._near.edges
        index, foot = edges.nearest(flat)
        arm = flat[:, :2] - foot
        distance = np.hypot(arm[:, 0], arm[:, 1])
        offset = self._frame.lift(arm)
        if entered:
            distance[self.contains(flat) & touching] *= -1.0
        if np.minimum.reduce(np.abs(distance)) > _ON_BOUNDARY:
            return NearestPoints(distance, -offset, offset / distance[:, None])
        off = np.abs(distance) > _ON_BOUNDARY
        along = edges.direction[index]
        normal = self._frame.lift(np.column_stack((along[:, 1], -along[:, 0])))
        normal[off] = offset[off] / distance[off, None]
        return NearestPoints(distance, -offset, normal)

    def signed_distance(self, flat, touching):
        """Signed distances (K,) [m] of points (K, 3) of the plane, of a polyline as in
        ``nearest``; beyond the band it may come out too large."""
        edges = self._whole.edges if touching else self._near.edges
        distance = np.sqrt(edges.measure(flat)[0].min(axis=0))
        return np.where(self.contains(flat), -distance, distance) if touching else distance

    def contains(self, flat):
        """Whether points (K, 3) of the plane are inside, not on the boundary."""
        return shapely.contains_xy(self._polygon, flat[:, 0], flat[:, 1])

    @property
    def corners(self):
        """The polygon's corners (E, 3) near the polylines given to ``approach`` last."""
        return self._near.corners

    def deepest(self, lines, slack):
        """DeepPoints of polylines (T, P, 3) in the plane; see depth.deepest_points."""
        return deepest_points(self._whole.edges, self._polygon, lines, slack)

    def _vertex_distances(self, lines, band):
        """Squared distances (C, P) [m^2] of the polylines' points to the boundary.

        Exact as far as they matter: see that the neighbourhood covers all points of the boundary
        within the polylines' minima, and within the band of the first one.
        """
        flat = lines.reshape(-1, 3)
        box = np.minimum.reduce(flat)[:2], np.maximum.reduce(flat)[:2]
        for _ in range(2):
            squared = np.minimum.reduce(self._near.edges.measure(flat)[0]).reshape(lines.shape[:2])
            least = np.minimum.reduce(squared, axis=1).tolist()
            reach = max(math.sqrt(least[0]) + band, math.sqrt(max(least))) + 2.0 * PROBE
            spare = self._near.margin(box) - reach
            if 0.0 <= spare <= 3.0 * _SKIN:
                break
            self._near = self._within(box[0] - reach - _SKIN, box[1] + reach + _SKIN)
        return squared

    def _within(self, lower, upper):
        """The _Neighbourhood of a box."""
        starts, ends = self._starts, self._ends
        touched = (np.minimum(starts, ends) <= upper) & (np.maximum(starts, ends) >= lower)
        chosen = np.flatnonzero(touched.all(axis=1))
        edges = SegmentSet(starts[chosen], (ends - starts)[chosen])
        corners = np.column_stack((starts[chosen], np.ones(chosen.size)))
        return _Neighbourhood(edges, corners, lower, upper)
