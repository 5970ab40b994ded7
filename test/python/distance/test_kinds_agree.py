"""One solid as mesh, primitive, cloud, voxels and field: each is as near as its resolution lets."""

import mesh_reference
import numpy as np
import pytest

from deformable_manipulation import _distance

RADIUS = 0.4  # m, of a ball
SPACING = 0.02  # m, of points, cells and values


def minima(obstacle, copies, triangles=None):
    return _distance.MinimumDistance([obstacle], 0.0, 0.1).compute(copies, triangles).minimum


@pytest.fixture(scope="module", params=[False, True], ids=["rope", "fabric"])
def scene(request):
    """Objects outside, and the exact distances from the ball, which the primitive gives."""
    rng = np.random.default_rng(1)
    copies, triangles = [], None
    while len(copies) < 40:
        middle = rng.normal(size=3)
        points, triangles = mesh_reference.sheet(rng, cells=4, size=0.5, middle=middle)
        if not request.param:
            triangles = None
        ball = _distance.PrimitiveObstacle.sphere(RADIUS)
        if minima(ball, points[None], triangles)[0] > 0.01:
            copies.append(points)
    copies = np.array(copies)
    exact = minima(_distance.PrimitiveObstacle.sphere(RADIUS), copies, triangles)
    return copies, triangles, exact


def directions(count):
    """Points of a sphere at about equal distances: a golden spiral."""
    height = 1.0 - (2.0 * np.arange(count) + 1.0) / count
    angle = np.pi * (1.0 + 5.0**0.5) * np.arange(count)
    aside = np.sqrt(1.0 - height**2)
    return np.column_stack((aside * np.cos(angle), aside * np.sin(angle), height))


def test_a_mesh(scene):
    copies, triangles, exact = scene
    vertices, faces = mesh_reference.star(np.random.default_rng(14), rings=40, sectors=80)
    vertices *= RADIUS / np.linalg.norm(vertices, axis=1, keepdims=True)
    found = minima(_distance.MeshObstacle(vertices, faces), copies, triangles)
    sagitta = RADIUS * (1.0 - np.cos(0.5 * np.hypot(np.pi / 40, 2.0 * np.pi / 80)))
    assert (found - exact >= -1e-9).all() and (found - exact <= sagitta).all()


def test_a_cloud(scene):
    """Between points the surface of the balls is lower; it is nowhere higher than their radius."""
    copies, triangles, exact = scene
    count = int(4.0 * np.pi * RADIUS**2 / SPACING**2)
    points, radius = RADIUS * directions(count), 0.7 * SPACING
    obstacle = _distance.CloudObstacle(_distance.PointCloud(points), radius)
    found = minima(obstacle, copies, triangles)
    assert (found >= exact - radius - 1e-6).all()
    assert (found <= exact).all()


def test_voxels(scene):
    """The cells that the ball reaches into hold it, and reach a diagonal farther at most."""
    copies, triangles, exact = scene
    line = np.arange(-25, 25)
    cells = np.stack(np.meshgrid(line, line, line), axis=-1).reshape(-1, 3)
    nearest = np.clip(0.0, SPACING * cells, SPACING * (cells + 1))
    inside = cells[np.linalg.norm(nearest, axis=1) <= RADIUS]
    obstacle = _distance.MeshObstacle.of_cells(inside.astype(np.int32), SPACING)
    found = minima(obstacle, copies, triangles)
    assert (found <= exact + 1e-9).all()
    assert (found >= exact - np.sqrt(3.0) * SPACING - 1e-9).all()


def test_a_field(scene):
    """Interpolation of a distance r from a centre is off by h^2 / 4 r at most, and above it."""
    copies, triangles, exact = scene
    line = np.arange(-3.0, 3.0, SPACING * 2.0)
    grid = np.stack(np.meshgrid(line, line, line, indexing="ij"), axis=-1)
    values = np.linalg.norm(grid, axis=-1) - RADIUS
    obstacle = _distance.FieldObstacle(values, line[[0, 0, 0]], np.full(3, 2.0 * SPACING), True)
    found = minima(obstacle, copies, triangles)
    assert (found >= exact - 2e-5).all()
    assert (found <= exact + (2.0 * SPACING) ** 2 / (4.0 * RADIUS) + 2e-5).all()
