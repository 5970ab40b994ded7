"""Fabrics given by size and resolution: particles, triangles, and the sizes that are refused."""

from collections import Counter

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from deformable_manipulation.objects.fabric_grid import grid_mesh
from deformable_manipulation.scenario import scenario_from_mapping

cells = st.integers(1, 12)


def sides(triangle):
    return [tuple(sorted((triangle[i], triangle[(i + 1) % 3]))) for i in range(3)]


def test_the_fabric_of_the_paper():
    mesh = grid_mesh((2.0, 2.0), (14, 14))
    assert len(mesh.vertices) == 225 and len(mesh.triangles) == 392
    corners = [mesh.vertices[index] for index in (0, 14, 210, 224)]
    assert corners == [(0.0, 0.0, 0.0), (2.0, 0.0, 0.0), (0.0, 2.0, 0.0), (2.0, 2.0, 0.0)]


@given(columns=cells, rows=cells)
def test_particles_are_numbered_along_x_first(columns, rows):
    vertices = np.array(grid_mesh((1.5, 2.5), (columns, rows)).vertices)
    grid = vertices.reshape(rows + 1, columns + 1, 3)
    np.testing.assert_allclose(grid[0, :, 0], np.linspace(0.0, 1.5, columns + 1), atol=1e-15)
    np.testing.assert_allclose(grid[:, 0, 1], np.linspace(0.0, 2.5, rows + 1), atol=1e-15)
    assert (grid[..., 0] == grid[0, :, 0]).all() and (grid[..., 2] == 0.0).all()


@given(columns=cells, rows=cells)
def test_triangles_cover_the_rectangle_and_face_upwards(columns, rows):
    mesh = grid_mesh((1.5, 2.5), (columns, rows))
    corners = np.array(mesh.vertices)[np.array(mesh.triangles)]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert (normals[:, 2] > 0.0).all()
    assert 0.5 * normals[:, 2].sum() == pytest.approx(1.5 * 2.5)
    uses = Counter(side for triangle in mesh.triangles for side in sides(triangle))
    assert sorted(set(uses.values()) - {2}) in ([1], [])
    assert sum(count == 1 for count in uses.values()) == 2 * (columns + rows)


@given(columns=cells, rows=cells)
def test_diagonals_alternate(columns, rows):
    mesh = grid_mesh((1.0, 1.0), (columns, rows))
    step = columns + 1
    edges = {side for triangle in mesh.triangles for side in sides(triangle)}
    rising = {
        (row, column)
        for row in range(rows)
        for column in range(columns)
        if (row * step + column, (row + 1) * step + column + 1) in edges
    }
    assert rising == {
        (row, column) for row in range(rows) for column in range(columns) if (row + column) % 2 == 0
    }


@pytest.mark.parametrize("size, nearest", [(2.1, "2 or 2.14285714"), (0.05, "0.142857143")])
def test_sizes_of_no_whole_number_of_cells(fabric_mapping, change, problems_of, size, nearest):
    found = problems_of(
        change(
            fabric_mapping, "object", dict(fabric_mapping["object"], size=[size, 2.0], resolution=7)
        )
    )
    assert list(found) == ["object.size.0"]
    assert (
        "cells of 1 / resolution = 0.142857 m; nearest: {}".format(nearest)
        in found["object.size.0"]
    )


def test_nearest_sizes_are_accepted(fabric_mapping, change, tmp_path):
    change(fabric_mapping, "object.resolution", 7)
    change(fabric_mapping, "agents.helper.particle", 6)
    change(fabric_mapping, "agents.helper.start", [0.7, 0.0, 1.0])
    change(fabric_mapping, "object.size", [0.857142857, 1.0])
    assert scenario_from_mapping(fabric_mapping, tmp_path).object.particles == 7 * 8


def test_too_many_particles(fabric_mapping, change, problems_of):
    found = problems_of(change(fabric_mapping, "object.resolution", 200.0))
    assert "makes 201 x 201 particles; at most 20000" in found["object.resolution"]
