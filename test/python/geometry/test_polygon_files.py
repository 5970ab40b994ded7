"""Polygons from GeoJSON and from CSV as spreadsheets write it."""

import json

import numpy as np
import pytest
import shapely

from deformable_manipulation.geometry.polygon_files import read_rings
from deformable_manipulation.geometry.polygons import PolygonError, check_rings
from deformable_manipulation.geometry.regions import oriented_rings, polygon_region

OUTLINE = [[0, 0], [9, 0], [9, 6], [0, 6], [0, 0]]
HOLE = [[1, 1], [1, 5], [4, 5], [4, 1], [1, 1]]
ELSEWHERE = [[20, 0], [21, 0], [20, 1], [20, 0]]
YARD = {"type": "Polygon", "coordinates": [OUTLINE, HOLE]}
SHED = {"type": "Polygon", "coordinates": [ELSEWHERE]}
PIECES = {"type": "MultiPolygon", "coordinates": [[OUTLINE, HOLE], [ELSEWHERE]]}


def feature(geometry):
    return {"type": "Feature", "properties": {"name": "yard"}, "geometry": geometry}


@pytest.fixture
def read(tmp_path):
    def read(content, name="yard.geojson", origin=(0.0, 0.0)):
        path = tmp_path / name
        path.write_text(content if isinstance(content, str) else json.dumps(content))
        return read_rings(path, origin)

    return read


@pytest.mark.parametrize("wrap", [lambda g: g, feature])
def test_a_polygon_with_a_hole(read, wrap):
    rings = read(wrap(YARD))
    assert [len(ring) for ring in rings] == [4, 4]
    assert polygon_region(rings).area == 9 * 6 - 3 * 4


@pytest.mark.parametrize(
    "document",
    [
        PIECES,
        feature(PIECES),
        {"type": "FeatureCollection", "features": [feature(YARD), feature(None), feature(SHED)]},
        {"type": "GeometryCollection", "geometries": [YARD, SHED]},
    ],
)
def test_several_polygons(read, document):
    rings = read(document, "pieces.json")
    assert len(rings) == 3 and polygon_region(rings).area == 9 * 6 - 3 * 4 + 0.5


def test_polygons_that_share_a_side_become_one(read):
    beside = [[9, 0], [12, 0], [12, 6], [9, 6], [9, 0]]
    rings = read({"type": "MultiPolygon", "coordinates": [[OUTLINE, HOLE], [beside]]})
    assert len(rings) == 2 and polygon_region(rings).area == 12 * 6 - 3 * 4


def test_heights_are_passed_over_and_an_origin_taken_off(read):
    far = [[x + 6e5, y + 5.4e6, 112.5] for x, y in OUTLINE]
    document = {"type": "Polygon", "coordinates": [far]}
    with pytest.raises(PolygonError, match="at most 1e.06 m"):
        read(document)
    assert np.array(read(document, origin=(6e5, 5.4e6))[0]).tolist() == OUTLINE[:-1]


@pytest.mark.parametrize(
    "document, reason",
    [
        ("{", "it is no JSON: .*line 1"),
        ([1, 2], "it is no GeoJSON: an object has no type"),
        ({"type": "FeatureCollection", "features": []}, "there is no polygon in it"),
        ({"type": "Feature", "geometry": None}, "there is no polygon in it"),
        ({"type": "Polygon"}, "null is where a list must be"),
        ({"type": "Polygon", "coordinates": []}, "a polygon has no rings"),
        ({"type": "Polygon", "coordinates": [[[0, "a"]]]}, r'\[0, "a"\] are not the coordinates'),
        (
            {"type": "FeatureCollection", "features": [feature(YARD), feature({"type": "Point"})]},
            "feature 1: a Point bounds no region; only Polygon and MultiPolygon do; remove it",
        ),
        ({**YARD, "crs": {"properties": {"name": "urn:ogc:def:crs:OGC:1.3:CRS84"}}}, "are degrees"),
        (
            {
                "type": "Polygon",
                "coordinates": [[[11.57, 48.137], [11.571, 48.137], [11.57, 48.138]]],
            },
            "seem to be degrees: .* export it in metres",
        ),
        (
            {"type": "Polygon", "coordinates": [OUTLINE, [[8, 1], [11, 1], [11, 2]]]},
            r"rings 0 and 1 cross or touch at \(9, ",
        ),
        (
            {"type": "Polygon", "coordinates": [OUTLINE, [[0, 3], [4, 1], [4, 5]]]},
            r"rings 0 and 1 cross or touch at \(0, 3\); move them apart, or join them",
        ),
        (
            {
                "type": "MultiPolygon",
                "coordinates": [[[[0, 0], [1, 1], [1, 0], [0, 1]]], [OUTLINE]],
            },
            "polygon 0 is not valid: Self-intersection",
        ),
    ],
)
def test_reasons(read, document, reason):
    with pytest.raises(PolygonError, match="yard.geojson: .*" + reason):
        read(document)


@pytest.mark.parametrize(
    "text",
    [
        "y;z\n0;0\n1,5;0\n0;2,5\n",
        '"y","z"\n"0","0"\n"1.5","0"\n"0","2.5"\n',
        '"0","0"\n"1,5","0"\n"0","2,5"\n',
        "0\t0\n1.5\t0\n0\t2.5\n",
        "'0'; '0'\n'1.5'; '0'\n'0'; '2.5'\n",
    ],
)
def test_separators_and_quotes(read, text):
    assert read(text, "ring.csv") == (((0.0, 0.0), (1.5, 0.0), (0.0, 2.5)),)


def test_a_faulty_ring_is_told_by_its_place():
    with pytest.raises(PolygonError, match="ring 1: a polygon needs 3 distinct points"):
        check_rings((OUTLINE, HOLE[:2]))


def test_rings_with_their_region_to_the_left():
    nested = [OUTLINE, HOLE, [[2, 2], [3, 2], [3, 3]]]
    areas = [shapely.LinearRing(ring).is_ccw for ring in oriented_rings(check_rings(nested))]
    assert sorted(areas) == [False, True, True]
