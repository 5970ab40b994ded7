"""Obstacles that are given by numbers in the scenario."""

import numpy as np
import pytest
import yaml

from deformable_manipulation.commands.check_scenario import main
from deformable_manipulation.distance.minimum_distance import MinimumDistance
from deformable_manipulation.obstacles.kinds import KINDS
from deformable_manipulation.obstacles.primitives import Box, BoxObstacle, HalfSpaceObstacle
from deformable_manipulation.obstacles.spec import obstacle_corners, placed
from deformable_manipulation.running.inspection import inspect_scenario
from deformable_manipulation.scenario import scenario_from_mapping, scenario_to_mapping

SHAPES = {
    "half_space": {"normal": [0.0, 1.0, 1.0]},
    "sphere": {"radius": 0.2},
    "box": {"size": [1.0, 2.0, 0.1]},
    "cylinder": {"radius": 0.1, "length": 0.6},
    "capsule": {"radius": 0.1, "length": 0.6},
}
TURNED = [0.0, 0.0, 0.6, 0.8]


def item(kind, **more):
    return {"name": kind, kind: SHAPES[kind], "translation": [0, 3, 0], "rotation": TURNED, **more}


@pytest.fixture
def read(mapping, tmp_path):
    def scenario(*items):
        mapping["obstacles"] = list(items)
        return scenario_from_mapping(mapping, tmp_path)

    return scenario


@pytest.mark.parametrize("kind", SHAPES)
def test_each_kind_is_read_and_written(kind, read):
    scenario = read(item(kind, motion={"topic": "pose"}))
    (obstacle,) = scenario.obstacles
    assert (obstacle.kind, obstacle.name, obstacle.rotation) == (kind, kind, tuple(TURNED))
    resolved = scenario_to_mapping(scenario)
    assert resolved["obstacles"][0][kind] == SHAPES[kind]
    assert scenario_from_mapping(resolved, "/nowhere") == scenario
    assert kind.replace("_", "-") in obstacle.description()


@pytest.mark.parametrize("kind", SHAPES)
def test_each_kind_is_drawn_as_far_as_it_reaches(kind, read):
    """Its surface is closed and faces outwards, and its corners have the distance 0 from it."""
    (obstacle,) = read(item(kind)).obstacles
    triangles = placed(obstacle, obstacle.drawing().triangles)
    first, second, third = np.moveaxis(triangles - triangles.mean(axis=(0, 1)), 1, 0)
    assert np.einsum("ti,ti->", first, np.cross(second, third)) > 0.0
    edges = np.round(np.concatenate((triangles[:, :2], triangles[:, 1:], triangles[:, ::-2])), 9)
    ways = {tuple(np.concatenate(edge)) for edge in edges}
    assert all(way[3:] + way[:3] in ways for way in ways)
    drawn = triangles.reshape(-1, 3)
    distances = MinimumDistance([obstacle], 0.0).compute(np.stack((drawn, drawn), axis=1)).minimum
    assert distances.max() < 1e-9
    corners = obstacle_corners(obstacle)
    if kind == "half_space":
        assert distances.min() == pytest.approx(-0.1)
        assert MinimumDistance([obstacle], 0.0).compute(corners[None]).minimum == pytest.approx(0.0)
    else:
        assert distances.min() > -1e-9
        own = obstacle.drawing().triangles.reshape(-1, 3)
        np.testing.assert_allclose(np.ptp(obstacle.corners(), axis=0), np.ptp(own, axis=0))


@pytest.mark.parametrize(
    "kind, shape, key, told",
    [
        ("sphere", {"radius": -1}, "sphere.radius", "must be a number >= 1e-06"),
        ("sphere", {}, "sphere.radius", "is missing; give a number"),
        ("sphere", 3, "sphere", "must be a section with keys radius"),
        ("box", {"size": [1, 2]}, "box.size", "must be a list [x, y, z]"),
        ("cylinder", {"radius": 1, "height": 2}, "cylinder.height", "is not a key here"),
        ("cylinder", {"radius": 1, "height": 2}, "cylinder.length", "is missing"),
        ("capsule", {"radius": 1, "length": "long"}, "capsule.length", "must be a number"),
        ("half_space", {"normal": [0, 0, 0]}, "half_space.normal", "must be longer than 1e-6"),
    ],
)
def test_mistakes_are_told(kind, shape, key, told, mapping, problems_of):
    mapping["obstacles"] = [{"name": kind, kind: shape}]
    assert told in problems_of(mapping)["obstacles.0." + key]


def test_a_mistyped_kind_is_told(mapping, problems_of):
    mapping["obstacles"] = [{"name": "ball", "sphre": {"radius": 1}}]
    assert "did you mean 'sphere'?" in problems_of(mapping)["obstacles.0"]


def test_only_one_kind_at_a_time(mapping, problems_of):
    mapping["obstacles"] = [{"name": "both", "box": {"size": [1, 2]}, "sphere": {"radius": 1}}]
    found = problems_of(mapping)
    assert set(found) == {"obstacles.0.box"}
    assert "cannot be combined with sphere; remove one of the two" in found["obstacles.0.box"]


def test_a_half_space_points_upwards_unless_told_otherwise(read):
    (ground,) = read({"name": "ground", "half_space": {}}).obstacles
    assert ground == HalfSpaceObstacle("ground", ground.half_space)
    assert ground.half_space.normal == (0.0, 0.0, 1.0)


def test_wrong_numbers_of_specs_that_were_not_read():
    wrong = BoxObstacle("box", Box((1.0, -1.0, 1.0)), rotation=(0.0, 0.0, 0.0, 2.0))
    with pytest.raises(ValueError, match="obstacle 'box': rotation is"):
        MinimumDistance([wrong], 0.0)
    with pytest.raises(ValueError, match="obstacle 'box': a side is -1"):
        MinimumDistance([BoxObstacle("box", Box((1.0, -1.0, 1.0)))], 0.0)


def test_they_are_described(read, capsys, tmp_path):
    scenario = read(*map(item, SHAPES))
    facts = "\n".join(inspect_scenario(scenario).facts)
    assert "obstacle sphere reaches from (-0.248, 2.752, -0.2) to" in facts
    assert "m, endless along and behind its plane" in facts
    path = tmp_path / "scenario.yaml"
    path.write_text(yaml.safe_dump(scenario_to_mapping(scenario)))
    assert main([str(path)]) == 0
    assert "cylinder of radius 0.1 m, 0.6 m long" in capsys.readouterr().out


def test_the_reference_backend_says_what_it_does_not_know(mapping, tmp_path):
    from deformable_manipulation.distance.reference import ReferenceMinimumDistance

    mapping["obstacles"] = [item("sphere")]
    (ball,) = scenario_from_mapping(mapping, tmp_path).obstacles
    with pytest.raises(ValueError, match="backend 'reference' has no sphere, only mesh and poly"):
        ReferenceMinimumDistance([ball], 0.0)


def test_every_kind_is_named_by_its_key():
    for key, kind in KINDS.items():
        assert kind.section.spec.kind == key and key in kind.section.fields
