"""Mesh obstacles in the scenario file."""

import pytest

from deformable_manipulation.geometry.mesh_files import scaled_mesh
from deformable_manipulation.scenario import (
    package_share_directory,
    scenario_from_mapping,
    scenario_to_mapping,
)
from deformable_manipulation.scenario.spec import MeshObstacle

CUBE = package_share_directory() / "config" / "obstacles" / "cube.obj"


@pytest.fixture
def cube(mapping):
    """A scenario with a polygon and a cube."""
    mapping["obstacles"].append({"name": "cube", "mesh": str(CUBE), "translation": [3, 0, 0]})
    return mapping


@pytest.mark.parametrize(
    "name", [str(CUBE), "package://deformable_manipulation/config/obstacles/cube.obj", "cube.obj"]
)
def test_file_names_become_absolute_paths(cube, change, name):
    change(cube, "obstacles.1.mesh", name)
    scenario = scenario_from_mapping(cube, CUBE.parent)
    assert scenario.obstacles[1] == MeshObstacle("cube", str(CUBE), (3.0, 0.0, 0.0))
    again = scenario_from_mapping(scenario_to_mapping(scenario), "/nowhere")
    assert again == scenario


@pytest.mark.parametrize("scale, expected", [(2, (2.0, 2.0, 2.0)), ([1, 2, 0.5], (1.0, 2.0, 0.5))])
def test_scale(cube, change, tmp_path, scale, expected):
    change(cube, "obstacles.1.scale", scale)
    assert scenario_from_mapping(cube, tmp_path).obstacles[1].scale == expected


WRONG = [
    ("mesh", "absent.obj", "obstacles.1.mesh", "absent.obj"),
    ("mesh", "package://nowhere_at_all/x.obj", "obstacles.1.mesh", "no ROS package"),
    ("mesh", "/dev/null", "obstacles.1.mesh", "/dev/null"),
    ("mesh", "a\0b.obj", "obstacles.1.mesh", ""),
    ("mesh", 3, "obstacles.1.mesh", "the name of a mesh file"),
    ("scale", 0, "obstacles.1.scale", "a number >= 1e-06"),
    ("scale", [1, 1], "obstacles.1.scale", "[x, y, z]"),
    ("scale", [1, -1, 1], "obstacles.1.scale.1", "a number >= 1e-06"),
    ("rotation", [0, 0, 0, 2], "obstacles.1.rotation", "norm 1"),
    ("plane", "xz", "obstacles.1.plane", "known keys: name, mesh"),
    ("polygon", [[0, 0], [1, 0], [1, 1]], "obstacles.1.mesh", "remove one of the two"),
]


@pytest.mark.parametrize("key, value, place, expected", WRONG)
def test_mistakes(cube, change, problems_of, key, value, place, expected):
    found = problems_of(change(cube, "obstacles.1." + key, value))
    assert list(found) == [place]
    assert expected in found[place]


def test_all_mistakes_at_once(cube, change, problems_of):
    change(cube, "obstacles.1.mesh", "absent.obj")
    change(cube, "obstacles.1.scale", -1)
    change(cube, "controller.gain", -1)
    assert set(problems_of(cube)) == {"obstacles.1.mesh", "obstacles.1.scale", "controller.gain"}


def test_an_obstacle_without_a_shape(mapping, problems_of):
    mapping["obstacles"] = [{"name": "nothing"}]
    found = problems_of(mapping)
    assert list(found) == ["obstacles.0"]
    assert "has no shape; give one of the keys polygon, mesh, half_space" in found["obstacles.0"]


def test_all_mistakes_of_an_obstacle_with_two_shapes(cube, change, problems_of):
    change(cube, "obstacles.1.polygon", 3)
    change(cube, "obstacles.1.plane", "ab")
    change(cube, "obstacles.1.scale", 2)
    assert set(problems_of(cube)) == {
        "obstacles.1.mesh",
        "obstacles.1.plane",
        "obstacles.1.polygon",
    }


def test_files_of_a_checked_mapping_are_not_read_again(cube, change):
    change(cube, "obstacles.1.mesh", "/nowhere/cube.obj")
    scenario = scenario_from_mapping(cube, "/nowhere", files_are_read=True)
    assert scenario.obstacles[1].mesh == "/nowhere/cube.obj"


FAR = "v 600000 5400000 0\nv 600001 5400000 0\nv 600000 5400001 0\nf 1 2 3\n"


def test_an_origin_is_taken_off(cube, change, problems_of, tmp_path):
    (tmp_path / "far.obj").write_text(FAR)
    change(cube, "obstacles.1.mesh", str(tmp_path / "far.obj"))
    assert "at most 1e+06 from the origin" in problems_of(cube)["obstacles.1.mesh"]
    change(cube, "obstacles.1.origin", [600000, 5400000, 0])
    scenario = scenario_from_mapping(cube, tmp_path)
    assert scenario.obstacles[1].origin == (600000.0, 5400000.0, 0.0)
    vertices = scaled_mesh(scenario.obstacles[1])[0]
    assert vertices.tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    assert scenario_from_mapping(scenario_to_mapping(scenario), "/nowhere") == scenario


def test_a_wrong_origin_is_told_once(cube, change, problems_of):
    found = problems_of(change(cube, "obstacles.1.origin", [1, 2]))
    assert list(found) == ["obstacles.1.origin"]
