"""Meshes whose triangles do not quite meet."""

import numpy as np
import pytest
import trimesh
from mesh_reference import cube

from deformable_manipulation import _distance
from deformable_manipulation.geometry.mesh_files import read_mended_mesh
from deformable_manipulation.geometry.mesh_mending import (
    WELDING_TOLERANCE,
    mended,
    split_at_corners,
)


def is_closed(vertices, triangles):
    return trimesh.Trimesh(vertices, triangles, process=False).is_watertight


def loose(vertices, triangles):
    """The same triangles, each with corners of its own."""
    return vertices[triangles].reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3)


def distance_of_middle(mesh):
    obstacle = _distance.MeshObstacle(mesh.vertices, mesh.triangles)
    calculator = _distance.MinimumDistance([obstacle], 0.0, 0.1, ["mesh"])
    middle = 0.5 * (mesh.vertices.min(axis=0) + mesh.vertices.max(axis=0))
    return calculator.compute(np.array([[middle, middle + 1e-3]]), None).minimum[0]


@pytest.mark.parametrize("at", [0.0, 1000.0])
def test_corners_one_step_of_single_precision_apart_are_one(tmp_path, at):
    vertices, triangles = cube((at, at, at), (at + 1.0, at + 1.0, at + 1.0))
    corners, faces = loose(vertices.astype(np.float32), triangles)
    corners[4] = np.nextafter(corners[4], np.float32(np.inf))
    path = tmp_path / "cube.stl"
    trimesh.Trimesh(corners, faces, process=False).export(path)
    mesh = read_mended_mesh(path)
    assert mesh.vertices.shape == (8, 3) and is_closed(*mesh[:2])
    assert distance_of_middle(mesh) == pytest.approx(-0.5, abs=1e-3)
    assert list(mesh.warnings()) == []


@pytest.mark.parametrize("gap, welded", [(0.5, True), (3.0, False)])
def test_the_tolerance_is_of_the_size(gap, welded):
    vertices, triangles = loose(*cube((0, 0, 0), (3, 4, 12)))
    vertices = vertices + 0.1
    for index in np.unique(triangles[5]):
        vertices[index] += [gap * WELDING_TOLERANCE * 13.0, 0.0, 0.0]
    assert is_closed(*mended(*_distinct(vertices, triangles))[:2]) == welded


def _distinct(vertices, triangles):
    unique, index = np.unique(vertices, axis=0, return_inverse=True)
    return unique, index.ravel()[triangles]


def test_closed_meshes_stay_as_they_are():
    vertices, triangles = cube()
    near = np.concatenate((vertices, vertices + 1e-9)), np.concatenate((triangles, triangles + 8))
    mesh = mended(*near)
    assert (mesh.vertices == near[0]).all() and (mesh.triangles == near[1]).all()


# A square of two triangles beside one of four, whose middle corner is on the first one's side.
SHEET = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (1, 0.5, 0), (2, 0, 0), (2, 1, 0)])
TORN = np.array([(0, 1, 2), (0, 2, 3), (1, 5, 4), (4, 5, 6), (4, 6, 2)])


def rim(triangles):
    edges = np.sort(np.concatenate((triangles[:, :2], triangles[:, 1:], triangles[:, ::2])), axis=1)
    unique, counts = np.unique(edges, axis=0, return_counts=True)
    return unique[counts == 1].tolist()


def test_a_corner_on_the_side_of_a_triangle_splits_it():
    assert [1, 2] in rim(TORN)
    mesh = mended(SHEET, TORN)
    assert mesh.vertices.tolist() == SHEET.tolist()
    assert rim(mesh.triangles) == [[0, 1], [0, 3], [1, 5], [2, 3], [2, 6], [5, 6]]
    assert mesh.splits == 1
    (warning,) = mesh.warnings()
    assert "1 place" in warning and "(1, 0.5, 0)" in warning


@pytest.mark.parametrize("offset, splits", [(1e-7, 1), (1e-3, 0)])
def test_how_near_to_the_side_it_must_be(offset, splits):
    vertices = SHEET + np.where(np.arange(7) == 4, offset, 0.0)[:, None] * [1.0, 0.0, 0.0]
    assert split_at_corners(vertices, TORN).splits == splits


@pytest.mark.parametrize("seed", range(5))
def test_many_corners_on_all_sides(seed):
    """A triangle among finer ones, with several corners on each of its sides."""
    random = np.random.default_rng(seed)
    corners = np.array([(0.0, 0.0, 0.0), (1.0, 0.0, 0.1), (0.3, 1.0, 0.0)])
    vertices, triangles = list(corners), [(0, 1, 2)]
    for a, b in ((0, 1), (1, 2), (2, 0)):
        away = corners[[a, b]].mean(axis=0) * 2.0 - corners[3 - a - b]
        parts = np.sort(random.uniform(0.05, 0.95, 4))
        chain = [a, *range(len(vertices), len(vertices) + 4), b]
        vertices += [corners[a] + part * (corners[b] - corners[a]) for part in parts]
        triangles += [(chain[k + 1], chain[k], len(vertices)) for k in range(5)]
        vertices.append(away)
    mesh = mended(np.array(vertices), np.array(triangles))
    assert mesh.splits == 12 and len(mesh.triangles) == 28
    assert len(rim(mesh.triangles)) == 6
    assert trimesh.Trimesh(*mesh[:2], process=False).area == pytest.approx(
        trimesh.Trimesh(vertices, triangles, process=False).area
    )
    assert mended(mesh.vertices, mesh.triangles).splits == 0


def test_a_solid_with_such_a_corner_has_an_inside():
    vertices, triangles = cube()
    a, b, c = triangles[0]
    vertices = np.concatenate((vertices, [0.5 * (vertices[a] + vertices[b])]))
    finer = np.concatenate((triangles[1:], [(a, len(vertices) - 1, c), (len(vertices) - 1, b, c)]))
    mesh = mended(vertices, finer)
    assert is_closed(*mesh[:2]) and mesh.splits == 1
    assert distance_of_middle(mesh) == pytest.approx(-0.5, abs=1e-2)
