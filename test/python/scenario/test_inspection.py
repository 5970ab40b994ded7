"""What check_scenario tells of a correct scenario."""

import pytest

from deformable_manipulation.running.inspection import inspect_scenario
from deformable_manipulation.scenario import scenario_from_mapping


def inspected(mapping, directory="."):
    return inspect_scenario(scenario_from_mapping(mapping, str(directory)))


def only_warning(mapping, directory="."):
    (warning,) = inspected(mapping, directory).warnings
    return warning


def test_nothing_unusual(mapping):
    inspection = inspected(mapping)
    assert inspection.warnings == ()
    facts = "\n".join(inspection.facts)
    assert "at the start the object reaches from (" in facts
    assert "obstacle block reaches from (" in facts and "endless across its plane" in facts
    assert "distance from the obstacles at the start: " in facts


def test_the_barriers_in_use(mapping):
    mapping["controller"]["workspace"] = {"lower": [-50.0, -50.0, -50.0], "margin": 0.03}
    inspection = inspected(mapping)
    barriers = {
        line.split(":")[0]: line for line in inspection.facts if line.startswith("barrier ")
    }
    assert list(barriers) == [
        "barrier {}".format(name)
        for name in scenario_from_mapping(mapping, ".").controller.barriers
    ]
    assert "margin 0.03 m; h at the start: " in barriers["barrier workspace"]
    offset = mapping["controller"]["collision"]["offset"]
    assert "offset {:g} m".format(offset) in barriers["barrier collision"]
    (distance,) = (line for line in inspection.facts if line.startswith("distance from"))
    start = float(distance.split(": ")[1].split()[0])
    h = float(barriers["barrier collision"].split()[-2])
    assert h == pytest.approx(start - offset, abs=1e-3)


def test_barriers_without_anything_to_keep_from(mapping):
    mapping["obstacles"] = []
    facts = inspected(mapping).facts
    (collision,) = (line for line in facts if line.startswith("barrier collision"))
    assert collision.endswith("nothing to keep from")


def test_an_obstacle_in_millimetres(mapping, tmp_path):
    (tmp_path / "sheet.obj").write_text(
        "v 0 0 0\nv 1000 0 0\nv 0 1000 0\nv 0 0 -1000\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n"
    )
    mapping["obstacles"] = [
        {"name": "bed", "mesh": "sheet.obj", "translation": [-500.0, -500.0, -5.0]}
    ]
    warning = only_warning(mapping, tmp_path)
    assert "obstacle bed: it is 1000 m long" in warning and "a scale of 0.001" in warning
    mapping["obstacles"][0]["scale"] = [1e-6, 1e-6, 1e-6]
    mapping["obstacles"][0]["translation"] = [0.0, 0.0, -5.0]
    assert "it is only 0.001 m long" in only_warning(mapping, tmp_path)


def test_a_start_within_the_offset(mapping):
    mapping["controller"]["collision"]["offset"] = 5.0
    assert "closer than controller.collision.offset, 5000.0 mm" in only_warning(mapping)


def test_a_path_that_is_too_long_or_too_fast(mapping):
    mapping["simulation"]["duration"] = 1.0
    assert "before the leader's path" in only_warning(mapping)
    mapping["simulation"]["duration"] = 100.0
    mapping["leader"]["waypoints"] = [
        {"time": 0.0, "position": [0.0, 0.0, 0.0]},
        {"time": 1.0, "position": [0.0, 0.0, 1.0]},
    ]
    assert "m/s; assistants reach" in only_warning(mapping)


@pytest.mark.parametrize("key", ["young_modulus", "torsion_modulus"])
def test_a_modulus_in_megapascals(mapping, key):
    mapping["object"][key] = 30.0
    assert f"object.{key}: 30 Pa is softer" in "\n".join(inspected(mapping).warnings)


def test_margins_that_do_not_fit_a_small_object(mapping):
    mapping["controller"]["perturbation"] = [0.1, 0.1, 0.5]
    assert "controller.perturbation: 0.5 m is large compared with" in only_warning(mapping)
    mapping["controller"]["perturbation"] = [0.1, 0.1, 0.1]
    mapping["controller"].setdefault("overstretch", {})["margin"] = 0.1
    assert "controller.overstretch.margin: 0.1 m is large" in only_warning(mapping)


def test_a_fabric_like_a_rubber_band(fabric_mapping):
    fabric_mapping["object"]["stretching_compliance"] = 0.5
    warnings = "\n".join(inspected(fabric_mapping).warnings)
    assert "object.stretching_compliance: a square sheet grows by 0.5 m per newton" in warnings
