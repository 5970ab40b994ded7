"""Regions in GeoJSON."""

import json
import math
from typing import Any, Iterator, List, Sequence, Tuple

from deformable_manipulation.geometry.polygons import PolygonError, Ring, Rings

_DEGREES = ("CRS84", "EPSG::4326", "EPSG:4326")
_SMALLEST = 0.01  # m; what is smaller, far from 0, was meant in degrees
_LARGEST_DEGREES = (180.0, 90.0)
_PROJECT = "export it in metres, in a projected coordinate system such as UTM"


def geojson_rings(text: str, origin: Sequence[float]) -> Rings:
    """The rings around what the polygons of a file cover together.

    Polygons, MultiPolygons, GeometryCollections and features of them are read, with their holes.
    Polygons that overlap or share a side become one. Coordinates are metres, heights are passed
    over.

    Args:
        text: GeoJSON.
        origin: (2,) what is taken off all coordinates [m].

    Raises:
        PolygonError: it is no GeoJSON, has geometries that bound no region or none at all, or is
            in degrees.
    """
    try:
        document = json.loads(text)
    except ValueError as error:
        raise PolygonError("it is no JSON: {}".format(error)) from None
    except RecursionError:
        raise PolygonError("it is no GeoJSON: it is nested too deeply") from None
    _refuse_degrees_by_name(document)
    polygons = [_moved(rings, origin) for rings in _polygons(document, "")]
    if not polygons:
        raise PolygonError("there is no polygon in it")
    return polygons[0] if len(polygons) == 1 else _union(polygons)


def _polygons(item: Any, place: str) -> Iterator[List[Ring]]:
    """The rings of each polygon below an item, the outer one first."""
    kind = item.get("type") if isinstance(item, dict) else None
    if kind == "FeatureCollection":
        for index, feature in enumerate(_list(item.get("features"), place)):
            yield from _polygons(feature, "feature {}: ".format(index))
    elif kind == "Feature":
        if item.get("geometry") is not None:
            yield from _polygons(item["geometry"], place)
    elif kind == "GeometryCollection":
        for geometry in _list(item.get("geometries"), place):
            yield from _polygons(geometry, place)
    elif kind == "MultiPolygon":
        for polygon in _list(item.get("coordinates"), place):
            yield _rings(polygon, place)
    elif kind == "Polygon":
        yield _rings(item.get("coordinates"), place)
    elif kind is None:
        raise PolygonError(place + "it is no GeoJSON: an object has no type")
    else:
        text = "{}a {} bounds no region; only Polygon and MultiPolygon do; remove it"
        raise PolygonError(text.format(place, kind))


def _rings(coordinates: Any, place: str) -> List[Ring]:
    rings = [
        tuple(_point(point, place) for point in _list(ring, place))
        for ring in _list(coordinates, place)
    ]
    if not rings:
        raise PolygonError(place + "a polygon has no rings")
    _refuse_degrees_by_size(rings, place)
    return rings


def _point(point: Any, place: str) -> Tuple[float, float]:
    pair = _list(point, place)[:2]
    if len(pair) < 2 or not all(type(c) in (int, float) and math.isfinite(c) for c in pair):
        text = "{}{} are not the coordinates of a point"
        raise PolygonError(text.format(place, json.dumps(point)[:40]))
    return float(pair[0]), float(pair[1])


def _list(value: Any, place: str) -> List[Any]:
    if not isinstance(value, list):
        text = "{}it is no GeoJSON: {} is where a list must be"
        raise PolygonError(text.format(place, json.dumps(value)[:40]))
    return value


def _moved(rings: List[Ring], origin: Sequence[float]) -> Rings:
    return tuple(tuple((a - origin[0], b - origin[1]) for a, b in ring) for ring in rings)


def _refuse_degrees_by_name(document: Any) -> None:
    name = json.dumps(document.get("crs", "")) if isinstance(document, dict) else ""
    if any(each in name for each in _DEGREES):
        raise PolygonError("its coordinates are degrees ('crs'); " + _PROJECT)


def _refuse_degrees_by_size(rings: List[Ring], place: str) -> None:
    columns = list(zip(*(point for ring in rings for point in ring)))
    if columns and all(
        max(column) - min(column) < _SMALLEST and 1.0 < max(map(abs, column)) <= largest
        for column, largest in zip(columns, _LARGEST_DEGREES)
    ):
        text = "{}its coordinates seem to be degrees: it would be smaller than {:g} m; {}"
        raise PolygonError(text.format(place, _SMALLEST, _PROJECT))


def _union(polygons: List[Rings]) -> Rings:
    import shapely
    from shapely.validation import explain_validity

    shapes = []
    for index, rings in enumerate(polygons):
        usable = [ring for ring in rings if len(ring) >= 3]
        if len(usable) < len(rings):
            raise PolygonError("polygon {}: a ring needs 3 points or more".format(index))
        shapes.append(shapely.Polygon(rings[0], rings[1:]))
        if not shapes[-1].is_valid:
            reason = explain_validity(shapes[-1])
            raise PolygonError("polygon {} is not valid: {}".format(index, reason))
    united = shapely.unary_union(shapes)
    return tuple(
        tuple(map(tuple, shapely.get_coordinates(ring)[:-1].tolist()))
        for part in shapely.get_parts(united)
        for ring in (part.exterior, *part.interiors)
    )
