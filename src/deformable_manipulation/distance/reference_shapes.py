"""Obstacles for :mod:`.reference`, each by its library."""

import numpy as np

from deformable_manipulation.geometry.mesh_files import scaled_mesh
from deformable_manipulation.geometry.planes import PlaneFrame
from deformable_manipulation.geometry.polygons import check_rings
from deformable_manipulation.geometry.regions import oriented_rings, polygon_region
from deformable_manipulation.geometry.rotation import rotate

_TOUCHING = 1e-9  # m


def reference_shape(spec):
    """The shape of an obstacle's specification.

    Raises:
        ValueError: it is invalid, or of a kind that the libraries do not know.
    """
    if spec.kind not in _SHAPES:
        known = " and ".join(_SHAPES)
        raise ValueError("backend 'reference' has no {}, only {}".format(spec.kind, known))
    try:
        return _SHAPES[spec.kind](spec)
    except ImportError as error:
        raise ValueError(
            "backend 'reference' needs the Python packages trimesh, rtree and python-fcl "
            "({})".format(error)
        ) from error


def barycentric(point, corners):
    """Weights (3,) of a triangle's corners whose sum is nearest to a point of it."""
    edges = np.stack((corners[1] - corners[0], corners[2] - corners[0]), axis=1)
    u, v = np.linalg.lstsq(edges, point - corners[0], rcond=None)[0]
    weights = np.clip((1.0 - u - v, u, v), 0.0, 1.0)
    return weights / weights.sum()


class MeshShape:
    """A mesh: distances by FCL, signs and nearest points by Trimesh."""

    def __init__(self, spec):
        import fcl
        import rtree  # noqa: F401  Trimesh's proximity needs it
        import trimesh

        self._fcl, self._trimesh = fcl, trimesh
        vertices, triangles = scaled_mesh(spec)
        axes = np.array([rotate(spec.rotation, axis) for axis in np.eye(3)])
        placed = vertices @ axes + np.asarray(spec.translation)
        self._mesh = trimesh.Trimesh(placed, triangles, process=False)
        if self._mesh.is_watertight:
            self._mesh.fix_normals()
        self._object = self._collision_object(self._mesh.vertices, self._mesh.faces)

    def nearest(self, corners):
        """Distance [m] of a triangle, and the weights (3,) of its corners there."""
        request = self._fcl.DistanceRequest(enable_nearest_points=True)
        result = self._fcl.DistanceResult()
        element = self._collision_object(corners, np.array([[0, 1, 2]]))
        distance = self._fcl.distance(element, self._object, request, result)
        if distance <= 0.0:
            return 0.0, np.full(3, 1.0 / 3.0)
        return distance, barycentric(np.array(result.nearest_points[0]), corners)

    def reaches_inside(self, corners, distance):
        """Whether part of a triangle at a distance [m] from the surface is inside."""
        if not self._mesh.is_watertight:
            return False
        return distance <= _TOUCHING or self._mesh.contains(corners[:1])[0]

    def signed(self, points):
        """Signed distances [m] of points (K, 3)."""
        return -self._trimesh.proximity.signed_distance(self._mesh, points)

    def foot(self, point):
        """The nearest point of the surface."""
        return self._trimesh.proximity.closest_point(self._mesh, point[None])[0][0]

    def normal(self, point):
        """The surface's outward normal near a point of it."""
        triangle = self._trimesh.proximity.closest_point(self._mesh, point[None])[2][0]
        return self._mesh.face_normals[triangle]

    def _collision_object(self, vertices, triangles):
        model = self._fcl.BVHModel()
        model.beginModel(len(vertices), len(triangles))
        model.addSubModel(np.asarray(vertices), np.asarray(triangles))
        model.endModel()
        return self._fcl.CollisionObject(model, self._fcl.Transform())


class PolygonShape:
    """A polygon, endless along its normal, by Shapely in its plane."""

    def __init__(self, spec):
        import shapely

        self._shapely = shapely
        self._frame = PlaneFrame(spec.plane, spec.rotation)
        self._origin = np.asarray(spec.translation, dtype=float)
        self._rings = check_rings(spec.points)
        self._region = polygon_region(self._rings)

    def nearest(self, corners):
        """Distance [m] of a triangle to the boundary, and the weights (3,) of its corners there."""
        flat = self._frame.flatten(corners - self._origin)
        hull = self._shapely.MultiPoint(flat).convex_hull
        ends = self._shapely.shortest_line(hull, self._region.boundary)
        return ends.length, barycentric(np.array(ends.coords[0]), flat)

    def reaches_inside(self, corners, distance):
        """Whether part of a triangle at a distance [m] from the boundary is inside."""
        flat = self._frame.flatten(corners - self._origin)
        return distance <= _TOUCHING or self._region.contains(self._shapely.Point(flat[0]))

    def signed(self, points):
        """Signed distances [m] of points (K, 3)."""
        flat = self._shapely.points(self._frame.flatten(points - self._origin))
        unsigned = self._shapely.distance(self._region.boundary, flat)
        return np.where(self._shapely.contains(self._region, flat), -unsigned, unsigned)

    def foot(self, point):
        """The nearest point of the boundary, at the same place along the normal."""
        flat = self._frame.flatten(point - self._origin)
        ends = self._shapely.shortest_line(self._region.boundary, self._shapely.Point(flat))
        return point + self._frame.lift(np.array(ends.coords[0]) - flat)

    def normal(self, point):
        """The boundary's outward normal near a point of it."""
        flat = self._frame.flatten(point - self._origin)
        rings = oriented_rings(self._rings)
        sides = np.concatenate([np.stack((r, np.roll(r, -1, axis=0)), axis=1) for r in rings])
        edges = self._shapely.linestrings(sides)
        edge = int(np.argmin(self._shapely.distance(edges, self._shapely.Point(flat))))
        along = sides[edge, 1] - sides[edge, 0]
        return self._frame.lift(np.array([along[1], -along[0]]) / np.linalg.norm(along))


_SHAPES = {"mesh": MeshShape, "polygon": PolygonShape}
