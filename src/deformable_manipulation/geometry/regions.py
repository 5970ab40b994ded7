"""Regions of rings as shapes of Shapely."""

from functools import reduce

import shapely

from deformable_manipulation.geometry.polygons import Rings


def polygon_region(rings: Rings):
    """The Polygon or MultiPolygon that an odd number of rings enclose."""
    return reduce(shapely.symmetric_difference, [shapely.Polygon(ring) for ring in rings])


def oriented_polygons(rings: Rings):
    """The polygons that make up a region, outlines counterclockwise and holes clockwise."""
    return [
        shapely.geometry.polygon.orient(part) for part in shapely.get_parts(polygon_region(rings))
    ]


def oriented_rings(rings: Rings):
    """Rings (N, 2) that do not repeat their first point, with the region to their left."""
    return [
        shapely.get_coordinates(ring)[:-1]
        for part in oriented_polygons(rings)
        for ring in (part.exterior, *part.interiors)
    ]
