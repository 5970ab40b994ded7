"""A mesh sampled as a cloud, as voxels and as a field is as far away as the mesh, within bounds.

The bounds hold for any shape:

- cloud: if every point of the surface has a sample within h, its nearest one is at most h farther.
- voxels: cells whose middles are at most half a diagonal away hold all of the solid, and reach at
  most a whole diagonal beyond it.
- field: distances differ by at most the way between two places; so trilinear weights w of the
  corners c of a cell give an error of at most sum w |x - c| <= sqrt(3) / 2 spacings.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from deformable_manipulation import _distance
from deformable_manipulation.benchmarks.distance_cases import ball
from deformable_manipulation.obstacles.drawings import box_surface

ROUNDING = 2e-5  # m: that of the field's minimum


def lumpy_ball(rng):
    vertices, triangles = ball(200)
    return 0.4 * np.asarray(vertices) * rng.uniform(0.7, 1.0, 3), np.asarray(triangles)


def box(rng):
    corners = box_surface(-rng.uniform(0.1, 0.4, 3), rng.uniform(0.1, 0.4, 3)).triangles
    return corners.reshape(-1, 3), np.arange(36).reshape(12, 3)


def distances(obstacle, points):
    return np.asarray(_distance.MinimumDistance([obstacle], 0.0, 0.0).compute(points).minimum)


def at_places(obstacle, places):
    """Signed distances (N,) of places (N, 3), each as a copy of an object that is nowhere else."""
    return distances(obstacle, np.repeat(places[:, None], 2, axis=1))


def samples(corners, pieces):
    """Points of triangles (T, 3, 3), and how far [m] others of them are from one at most."""
    weights = [(i, j, pieces - i - j) for i in range(pieces + 1) for j in range(pieces + 1 - i)]
    points = (np.array(weights) / pieces) @ corners
    sides = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
    return points.reshape(-1, 3), sides.max() / pieces / np.sqrt(3.0)


def grid(low, high, spacing):
    lines = [np.arange(np.floor(a / spacing), np.ceil(b / spacing) + 1) for a, b in zip(low, high)]
    return np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1).astype(int)


@pytest.mark.parametrize("shape", [lumpy_ball, box])
@given(seed=st.integers(0, 2**31))
@settings(max_examples=8, deadline=None)
def test_the_distance_is_that_of_the_mesh(shape, seed):
    rng = np.random.default_rng(seed)
    vertices, triangles = shape(rng)
    mesh = _distance.MeshObstacle(vertices, triangles)
    lines = rng.uniform(-0.7, 0.7, (20, 1, 3)) + np.cumsum(rng.normal(0.0, 0.1, (20, 6, 3)), axis=1)
    lines = np.clip(lines, -0.9, 0.9)  # within the field
    true = distances(mesh, lines)
    outside = true > 0.0

    points, apart = samples(vertices[triangles], 12)
    radius = rng.uniform(0.0, 0.02)
    found = distances(_distance.CloudObstacle(_distance.PointCloud(points), radius), lines)
    off = (found - true + radius)[outside]
    assert (off >= -1e-6).all() and (off <= apart + 1e-6).all()

    size = 0.04
    cells = grid(vertices.min(axis=0) - size, vertices.max(axis=0), size).reshape(-1, 3)
    near = at_places(mesh, size * (cells + 0.5)) <= 0.5 * np.sqrt(3.0) * size
    off = distances(_distance.MeshObstacle.of_cells(cells[near], size), lines) - true
    assert (off[outside] <= 1e-6).all() and (off[outside] >= -np.sqrt(3.0) * size - 1e-6).all()

    places = 0.08 * grid((-1.0,) * 3, (1.0,) * 3, 0.08)
    values = at_places(mesh, places.reshape(-1, 3)).reshape(places.shape[:3])
    field = _distance.FieldObstacle(values, places[0, 0, 0], (0.08,) * 3, is_free_outside=True)
    off = np.abs(distances(field, lines) - true)
    assert (off <= np.sqrt(0.75) * 0.08 + ROUNDING).all()
