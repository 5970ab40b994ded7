"""The distance computation of a scenario: margins, triangles, backend."""

import dataclasses

import mesh_reference as reference
import numpy as np
import pytest
import trimesh

from deformable_manipulation.distance.factory import make_minimum_distance
from deformable_manipulation.distance.minimum_distance import MinimumDistance
from deformable_manipulation.distance.reference import ReferenceMinimumDistance
from deformable_manipulation.objects.fabric import FabricSpec
from deformable_manipulation.scenario.loader import load_scenario
from deformable_manipulation.scenario.spec import MeshObstacle

SHEET = ((0.2, 0.2, 1.1), (0.8, 0.2, 1.1), (0.5, 0.8, 1.1))


@pytest.fixture
def cube(tmp_path):
    trimesh.Trimesh(*reference.cube(), process=False).export(tmp_path / "cube.obj")
    return MeshObstacle("cube", str(tmp_path / "cube.obj"))


def scenario(body=None, obstacles=(), **collision):
    plain = load_scenario("rope_one_assistant")
    changed = dataclasses.replace(plain.controller.collision, **collision)
    controller = dataclasses.replace(plain.controller, collision=changed)
    return dataclasses.replace(
        plain, object=body or plain.object, obstacles=obstacles, controller=controller
    )


@pytest.mark.parametrize(
    "backend, kind", [("native", MinimumDistance), ("reference", ReferenceMinimumDistance)]
)
def test_fabrics_have_half_their_thickness(cube, backend, kind):
    fabric = FabricSpec(SHEET, ((0, 1, 2),), 1.0, 0.004, 1e-3, 1.0)
    distance = make_minimum_distance(scenario(fabric, (cube,), backend=backend))
    assert isinstance(distance, kind)
    result = distance.compute(np.array([SHEET]))
    assert result.minimum == pytest.approx([0.098], abs=1e-6)
    assert result.names == ("cube",)


def test_rods_have_their_radius_beside_meshes_and_polygons(cube):
    ground = load_scenario("rope_one_assistant").obstacles
    rod = scenario(obstacles=(cube,) + ground)
    distance = make_minimum_distance(rod)
    line = np.linspace([0.1, 0.5, 1.2], [0.9, 0.5, 1.2], 5)
    result = distance.compute(line[None])
    mesh = result.distance[result.obstacle == 0]
    assert mesh.min() == pytest.approx(0.2 - rod.object.radius, abs=1e-9)
    assert distance.names == ("cube",) + tuple(obstacle.name for obstacle in ground)
