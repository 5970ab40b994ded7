"""Prisms over regions, as triangles to be drawn."""

import numpy as np
import shapely

from deformable_manipulation.geometry.polygons import Rings
from deformable_manipulation.geometry.regions import oriented_polygons, oriented_rings


def prism(rings: Rings, axes: np.ndarray, half_width: float) -> np.ndarray:
    """Corners (T, 3, 3) [m] of the triangles around a prism, facing outwards.

    Args:
        rings: around the region.
        axes: (2, 3) unit vectors along which the rings' coordinates count.
        half_width: how far it reaches to both sides of their plane [m].
    """
    caps = np.concatenate([_triangles(part) for part in oriented_polygons(rings)])
    across = half_width * np.cross(*axes)
    surface = [caps[::-1] @ axes - across, caps @ axes + across]
    for ring in oriented_rings(rings):
        near, far = ring @ axes - across, ring @ axes + across
        next_near, next_far = np.roll(near, -1, axis=0), np.roll(far, -1, axis=0)
        sides = (near, next_near, far, far, next_near, next_far)
        surface.append(np.stack(sides, axis=1).reshape(-1, 3))
    return np.concatenate(surface).reshape(-1, 3, 3)


def _triangles(polygon) -> np.ndarray:
    """Corners (3 T, 2) of triangles that make up a polygon, counterclockwise."""
    triangles = shapely.get_parts(shapely.constrained_delaunay_triangles(polygon))
    counterclockwise = [shapely.geometry.polygon.orient(triangle) for triangle in triangles]
    return np.concatenate([shapely.get_coordinates(each)[:3] for each in counterclockwise])
