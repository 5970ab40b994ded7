"""The C++ core beside Trimesh, FCL and Shapely, through the interface that both have."""

import mesh_reference as reference
import numpy as np
import pytest
import trimesh
from mesh_reference import grid_triangles, sheet, star

from deformable_manipulation.distance.minimum_distance import MinimumDistance
from deformable_manipulation.distance.reference import ReferenceMinimumDistance
from deformable_manipulation.scenario.spec import MeshObstacle, PolygonObstacle

TURN = (0.5, 0.5, 0.5, 0.5)
RING = ((-1.0, -1.0), (1.0, -1.0), (1.0, 0.2), (0.0, 0.6), (-1.0, 0.1))


@pytest.fixture(scope="module")
def mesh_file(tmp_path_factory):
    path = tmp_path_factory.mktemp("meshes") / "star.ply"
    trimesh.Trimesh(*star(np.random.default_rng(5)), process=False).export(path)
    return str(path)


@pytest.fixture(scope="module")
def obstacles(mesh_file):
    return [
        MeshObstacle("star", mesh_file, (0.1, -0.2, 0.3), TURN, (1.0, 1.2, -0.8)),
        PolygonObstacle("hill", RING, "yz", (0.0, 0.3, -1.5)),
    ]


def both(obstacles, points, triangles, band=0.4):
    arguments = (obstacles, 0.003, band, triangles)
    return [
        backend(*arguments).compute(points)
        for backend in (MinimumDistance, ReferenceMinimumDistance)
    ]


@pytest.mark.parametrize("kind", ["fabric", "rod"])
@pytest.mark.parametrize("height", [2.6, 2.2])
def test_outside_both_agree(obstacles, kind, height):
    rng = np.random.default_rng(int(10 * height))
    points, triangles = sheet(rng, size=1.0, middle=(0.0, 0.0, height))
    if kind == "rod":
        points, triangles = np.linspace([-1.0, -1, height], [0.8, 1.2, height + 0.2], 9), None
    copies = points + [[[0, 0, 0]], [[0.1, 0, 0]], [[0, 0, 0.1]]]
    native, slow = both(obstacles, copies, triangles)
    assert native.minimum.min() > 0.0
    assert native.minimum == pytest.approx(slow.minimum, abs=1e-6)
    assert native.names == slow.names == ("star", "hill")
    assert sorted(native.identity) == sorted(slow.identity)
    expected = dict(zip(slow.identity[slow.of_copy(0)], slow.distance[slow.of_copy(0)]))
    found = dict(zip(native.identity[native.of_copy(0)], native.distance[native.of_copy(0)]))
    assert found == pytest.approx(expected, abs=1e-6)
    assert slow.normal[0] == pytest.approx(native.normal[0], abs=1e-3)
    arm = slow.object_point - slow.obstacle_point
    assert np.linalg.norm(arm, axis=1) == pytest.approx(slow.distance + 0.003, abs=1e-6)


@pytest.mark.parametrize("kind", ["fabric", "rod"])
def test_inside_both_agree_as_far_as_the_reference_can(obstacles, kind):
    points, triangles = sheet(np.random.default_rng(3), size=0.8, middle=(0.1, -0.1, 0.5))
    if kind == "rod":
        points, triangles = points[:4], None
    native, slow = both(obstacles, points[None], triangles)
    coarse = np.linalg.norm(np.diff(points, axis=0), axis=1).max() / 8.0
    assert native.minimum[0] < -0.1
    assert native.minimum[0] - 1.1e-5 <= slow.minimum[0]
    assert slow.minimum[0] <= native.minimum[0] + coarse


def test_a_polygon_alone_inside_and_outside(obstacles):
    hill = obstacles[1:]
    for height in (-1.2, -0.8):
        line = np.linspace([0.0, -0.5, height], [0.0, 0.9, height + 0.05], 12)
        native, slow = both(hill, line[None], None)
        assert slow.minimum == pytest.approx(native.minimum, abs=0.01)
    assert slow.normal[0] == pytest.approx(native.normal[0], abs=0.05)


def test_settings_and_shapes_are_refused_by_both(tmp_path):
    spoilt = [
        MeshObstacle("gone", str(tmp_path / "gone.obj")),
        MeshObstacle("flat", str(tmp_path / "gone.obj"), scale=(1.0, 0.0, 1.0)),
    ]
    for backend in (MinimumDistance, ReferenceMinimumDistance):
        with pytest.raises(ValueError) as caught:
            backend(spoilt, -1.0, triangles=[[0, 1]])
        for part in ("margin is -1.0", "triangles must be", "'flat': scale"):
            assert part in str(caught.value)
        with pytest.raises(ValueError, match="'gone': .*gone.obj cannot be read"):
            backend(spoilt[:1], 0.0)
        with pytest.raises(ValueError):
            backend([], 0.0, triangles=[[0, 1, 9]]).compute(np.zeros((1, 3, 3)))


def test_warnings_name_the_obstacle(tmp_path):
    vertices, triangles = reference.cube()
    trimesh.Trimesh(vertices, triangles[1:], process=False).export(tmp_path / "open.ply")
    opened = MeshObstacle("box", str(tmp_path / "open.ply"))
    (warning,) = MinimumDistance([opened], 0.0).warnings
    assert warning.startswith("obstacle 'box': 1 of 1 components are not closed")
    points = np.array([(0.5, 0.5, 0.5), (0.5, 0.6, 0.5), (0.6, 0.5, 0.5)])[None]
    native, slow = both([opened], points, [[0, 1, 2]])
    assert native.minimum[0] == pytest.approx(0.397, abs=1e-6)
    assert slow.minimum[0] == pytest.approx(native.minimum[0], abs=1e-6)


def test_no_obstacle():
    for backend in (MinimumDistance, ReferenceMinimumDistance):
        result = backend([], 0.1, triangles=grid_triangles(1)).compute(np.zeros((2, 4, 3)))
        assert np.isinf(result.minimum).all() and result.offsets.tolist() == [0, 0, 0]
