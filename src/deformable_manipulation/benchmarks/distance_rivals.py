"""Other libraries on the same distances.

Each is a callable of points (C, P, 3) that gives the minima (C,) [m], without a sign.
"""

import numpy as np


class ShapelyPolygon:
    """Shapely 2: the polygon is prepared, all copies go in one call."""

    name = "Shapely, shortest_line"

    def __init__(self, ring):
        import shapely

        self._shapely = shapely
        self._polygon = shapely.Polygon(ring)
        shapely.prepare(self._polygon)

    def __call__(self, points):
        lines = self._shapely.linestrings(points[:, :, 1:])
        return self._shapely.length(self._shapely.shortest_line(self._polygon, lines))


class FclMesh:
    """FCL: triangle to triangle; the object's tree is built anew for every copy."""

    name = "python-fcl, triangles"

    def __init__(self, vertices, triangles, object_triangles):
        import fcl

        self._fcl = fcl
        self._object_triangles = object_triangles
        self._obstacle = self._collision_object(vertices, triangles)
        self._request = fcl.DistanceRequest(enable_nearest_points=True)

    def __call__(self, points):
        distances = []
        for copy in points:
            body = self._collision_object(copy, self._object_triangles)
            result = self._fcl.DistanceResult()
            distances.append(self._fcl.distance(body, self._obstacle, self._request, result))
        return np.array(distances)

    def _collision_object(self, vertices, triangles):
        model = self._fcl.BVHModel()
        model.beginModel(len(vertices), len(triangles))
        model.addSubModel(vertices, triangles)
        model.endModel()
        return self._fcl.CollisionObject(model, self._fcl.Transform())


class TrimeshVertices:
    """Trimesh: the object's vertices alone, all copies in one call."""

    name = "Trimesh, vertices alone"

    def __init__(self, vertices, triangles):
        import rtree  # noqa: F401  Trimesh's proximity needs it
        import trimesh

        self._trimesh = trimesh
        self._mesh = trimesh.Trimesh(vertices, triangles, process=False)

    def __call__(self, points):
        nearest = self._trimesh.proximity.closest_point(self._mesh, points.reshape(-1, 3))
        return nearest[1].reshape(points.shape[:2]).min(axis=1)


class SciPyTree:
    """SciPy: the object's vertices alone and a cloud of points, all copies in one call."""

    name = "SciPy cKDTree, vertices alone"

    def __init__(self, points):
        from scipy.spatial import cKDTree

        self._tree = cKDTree(points)

    def __call__(self, points):
        distances, _ = self._tree.query(points.reshape(-1, 3))
        return distances.reshape(points.shape[:2]).min(axis=1)
