"""Polygons with holes in the scenario file, from GeoJSON and far from the origin."""

import json

import pytest

from deformable_manipulation.scenario import scenario_from_mapping, scenario_to_mapping

OUTLINE = [[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0]]
HOLE = [[1.0, 1.0], [2.0, 1.0], [2.0, 2.0]]
FAR = (600000.0, 5400000.0)


def far(ring):
    return [[a + FAR[0], b + FAR[1]] for a, b in ring]


def rings_as_lists(obstacle):
    return [[list(point) for point in ring] for ring in obstacle.rings]


@pytest.fixture
def read(mapping, tmp_path):
    def read(**keys):
        mapping["obstacles"] = [{"name": "yard", "translation": [0.0, 0.0, -9.0], **keys}]
        return scenario_from_mapping(mapping, tmp_path)

    return read


def test_an_outline_and_its_holes(read):
    scenario = read(polygon=[OUTLINE, HOLE])
    assert rings_as_lists(scenario.obstacles[0]) == [OUTLINE, HOLE]
    again = scenario_to_mapping(scenario)
    assert again["obstacles"][0]["polygon"] == [OUTLINE, HOLE]
    assert scenario_from_mapping(again, "/nowhere") == scenario


def test_a_single_ring_stays_a_list_of_points(read):
    assert scenario_to_mapping(read(polygon=[OUTLINE]))["obstacles"][0]["polygon"] == OUTLINE


@pytest.mark.parametrize("in_file", [False, True])
def test_an_origin_is_taken_off(read, tmp_path, in_file):
    rings = [far(OUTLINE), far(HOLE)]
    if in_file:
        document = {"type": "Polygon", "coordinates": rings}
        (tmp_path / "yard.geojson").write_text(json.dumps(document))
    scenario = read(polygon="yard.geojson" if in_file else rings, origin=list(FAR))
    assert rings_as_lists(scenario.obstacles[0]) == [OUTLINE, HOLE]
    assert "origin" not in scenario_to_mapping(scenario)["obstacles"][0]


@pytest.mark.parametrize(
    "keys, place, expected",
    [
        ({"polygon": far(OUTLINE)}, "polygon", "at most 1e+06 m"),
        ({"polygon": [OUTLINE, HOLE[:2]]}, "polygon", "ring 1: a polygon needs 3 distinct points"),
        ({"polygon": [OUTLINE, far(HOLE)], "origin": [0, 0, 0]}, "origin", "[a, b]"),
        ({"polygon": [OUTLINE, [[1, "a"]]]}, "polygon.1.0.1", "a number"),
        ({"polygon": [OUTLINE, [[3, 1], [5, 1], [5, 2]]]}, "polygon", "rings 0 and 1 cross"),
        ({"polygon": "yard.geojson"}, "polygon", "yard.geojson"),
    ],
)
def test_mistakes(mapping, problems_of, keys, place, expected):
    mapping["obstacles"] = [{"name": "yard", **keys}]
    assert expected in problems_of(mapping)["obstacles.0." + place]
