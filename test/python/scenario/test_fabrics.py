"""Fabrics in the scenario file: every mistake is told, and what is right comes back the same."""

import copy

import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from deformable_manipulation.scenario import (
    load_scenario,
    scenario_from_mapping,
    scenario_to_mapping,
    scenario_to_yaml,
)
from deformable_manipulation.scenario.limits import pair_limits

SQUARE = {
    "vertices": [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
    "triangles": [[0, 1, 2], [0, 2, 3]],
}


@pytest.fixture
def inline(fabric_mapping):
    """A correct scenario of a fabric whose mesh is in the scenario itself."""
    del fabric_mapping["object"]["size"], fabric_mapping["object"]["resolution"]
    fabric_mapping["object"]["mesh"] = copy.deepcopy(SQUARE)
    fabric_mapping["agents"]["helper"]["particle"] = 1
    return fabric_mapping


WRONG_VALUES = [
    ("object.size", 1.0, "[along x, along y]"),
    ("object.size.1", -1.0, "a number > 0"),
    ("object.resolution", 0, "a number > 0"),
    ("object.density", 0, "a number > 0 and <= 10000 [kg/m^2]"),
    ("object.thickness", "thin", "a number > 0 and <= 1 [m]"),
    ("object.stretching_compliance", -1e-9, "a number >= 0 and <= 1e+06 [m/N]"),
    ("object.bending_compliance", None, "a number >= 0 and <= 1e+12 [1/(N m)]"),
    ("object.mesh", 3, "cannot be combined with mesh"),
    ("object.scale", 2.0, "applies only to mesh files"),
    ("object.segments", 3, "known keys: type, material, size, resolution, mesh"),
    ("agents.helper.particle", 25, "0 to 24"),
    ("agents.helper.start", [1.1, 0.0, 1.0], "beyond the free length 1 m"),
    ("simulation.solver", "direct", "applies only to rods; remove it"),
    ("simulation.substeps", "many", "or auto"),
]


@pytest.mark.parametrize("key, value, expected", WRONG_VALUES)
def test_wrong_value(fabric_mapping, change, problems_of, key, value, expected):
    found = problems_of(change(fabric_mapping, key, value))
    assert any(expected in text for text in found.values()), found


@pytest.mark.parametrize("key", ["size", "resolution"])
def test_missing_half_of_a_shape(fabric_mapping, problems_of, key):
    del fabric_mapping["object"][key]
    found = problems_of(fabric_mapping)
    assert list(found) == ["object." + key]
    assert "give size and resolution, or mesh instead" in found["object." + key]


WRONG_MESHES = [
    ("object.mesh.vertices", [], "object.mesh.vertices"),
    ("object.mesh.vertices.2", [0, 0], "object.mesh.vertices.2"),
    ("object.mesh.vertices.2.1", float("nan"), "object.mesh.vertices.2.1"),
    ("object.mesh.triangles", None, "object.mesh.triangles"),
    ("object.mesh.triangles.1", [0, 2], "object.mesh.triangles.1"),
    ("object.mesh.triangles.1", [0, 2, 4], "object.mesh.triangles.1"),
    ("object.mesh.triangles.1", [0, 2, 2], "object.mesh.triangles.1"),
    ("object.mesh.triangles.1.0", -1, "object.mesh.triangles.1.0"),
    ("object.mesh.faces", [], "object.mesh.faces"),
    ("object.mesh", "absent.obj", "object.mesh"),
]


@pytest.mark.parametrize("key, value, expected", WRONG_MESHES)
def test_wrong_mesh(inline, change, problems_of, key, value, expected):
    assert list(problems_of(change(inline, key, value))) == [expected]


def test_what_the_simulation_refuses_is_a_mistake_like_others(inline, change, problems_of):
    change(inline, "object.mesh.vertices.2", [0.5, 0.0, 0.0])  # a triangle without area
    change(inline, "controller.gain", -1)
    found = problems_of(inline)
    assert set(found) == {"object.mesh.triangles", "controller.gain"}
    assert "has no area must be of three corners" in found["object.mesh.triangles"]


def test_file_and_scale(inline, change, tmp_path):
    text = "".join("v {} {} {}\n".format(*vertex) for vertex in SQUARE["vertices"])
    text += "".join("f {} {} {}\n".format(*(i + 1 for i in each)) for each in SQUARE["triangles"])
    (tmp_path / "square.obj").write_text(text)
    change(inline, "object.mesh", "square.obj")
    change(inline, "object.scale", [2.0, 1.0, 1.0])
    fabric = scenario_from_mapping(inline, tmp_path).object
    assert max(x for x, _, _ in fabric.vertices) == 2.0
    assert max(y for _, y, _ in fabric.vertices) == 1.0
    assert len(fabric.triangles) == 2


def test_an_inline_mesh_is_split_where_it_would_tear(inline, change, tmp_path):
    change(inline, "object.mesh.vertices", [*SQUARE["vertices"], [0.5, 0.5, 0.0]])
    change(inline, "object.mesh.triangles", [[0, 1, 2], [0, 4, 3], [4, 2, 3]])
    scenario = scenario_from_mapping(inline, tmp_path)
    assert len(scenario.object.vertices) == 5 and len(scenario.object.triangles) == 4
    assert "(0.5, 0.5, 0)" in next(scenario.object.warnings())
    again = scenario_from_mapping(scenario_to_mapping(scenario), "/nowhere")
    assert again == scenario and not list(again.object.warnings())


def test_places_and_limits(fabric_mapping, tmp_path):
    del fabric_mapping["agents"]["helper"]["start"]
    fabric_mapping["object"]["pose"] = {
        "position": [1.0, 2.0, 3.0],
        "orientation": [0.0, 0.0, 0.6, 0.8],
    }
    fabric_mapping["agents"]["hand"].pop("start")
    fabric_mapping["agents"]["helper"]["particle"] = 4
    fabric_mapping["controller"]["overstretch"] = {"fraction": 1.0}
    scenario = scenario_from_mapping(fabric_mapping, tmp_path)
    assert scenario.agents[0].start == (1.0, 2.0, 3.0)
    # Turned by 2 atan(0.6 / 0.8): cos 0.28, sin 0.96.
    assert scenario.agents[1].start == pytest.approx((1.28, 2.96, 3.0))
    assert pair_limits(scenario, 0, 1).max_distance == pytest.approx(1.0)


@pytest.mark.parametrize("time_step, substeps", [(0.01, 10), (0.02, 20), (0.0005, 1)])
def test_substeps_suit_the_object(fabric_mapping, mapping, change, tmp_path, time_step, substeps):
    change(fabric_mapping, "object.stretching_compliance", 1e-2)
    change(fabric_mapping, "simulation.time_step", time_step)
    assert scenario_from_mapping(fabric_mapping, tmp_path).simulation.substeps == substeps
    change(mapping, "simulation.time_step", time_step)
    assert scenario_from_mapping(mapping, tmp_path).simulation.substeps == 2
    change(fabric_mapping, "simulation.substeps", 3)
    assert scenario_from_mapping(fabric_mapping, tmp_path).simulation.substeps == 3


@settings(max_examples=30, deadline=None)
@given(
    cells=st.tuples(st.integers(1, 4), st.integers(1, 4)),
    resolution=st.floats(2.0, 50.0),
    density=st.floats(1e-3, 10.0),
    compliance=st.floats(0.0, 1e-3),
)
def test_round_trip(correct_fabric, cells, resolution, density, compliance):
    raw = copy.deepcopy(correct_fabric)
    raw["object"].update(
        size=[count / resolution for count in cells],
        resolution=resolution,
        density=density,
        stretching_compliance=compliance,
    )
    raw["agents"] = {
        "hand": {"particle": 0, "role": "leader"},
        "helper": {"particle": cells[0], "role": "assistant"},
    }
    raw["controller"].update(perturbation=[1e-3] * 3, overstretch={"fraction": 1.0})
    scenario = scenario_from_mapping(raw, "/nowhere")
    mapping = scenario_to_mapping(scenario)
    assert scenario_from_mapping(mapping, "/nowhere", files_are_read=True) == scenario
    assert yaml.safe_load(scenario_to_yaml(scenario)) == mapping
    assert "solver" not in mapping["simulation"]


def test_the_fabric_scenario_resolved_is_the_same(tmp_path):
    scenario = load_scenario("fabric_three_assistants")
    path = tmp_path / "resolved.yaml"
    path.write_text(scenario_to_yaml(scenario))
    assert load_scenario(path) == scenario
