"""Depth images against rays that are traced one by one."""

import numpy as np
import pytest

from deformable_manipulation.obstacles.drawings import box_surface
from deformable_manipulation.seeing.object_surface import balls, tube
from deformable_manipulation.seeing.rendering import Raster


def traced(directions, triangles):
    """Depths (N,) [m] of the nearest triangle along rays with z = 1 (Cramer's rule)."""
    depths = np.full(len(directions), np.inf)
    for a, b, c in triangles:
        # t d = a + v (b - a) + w (c - a)
        system = np.stack([directions, np.broadcast_to(a - b, directions.shape),
                           np.broadcast_to(a - c, directions.shape)], axis=2)  # fmt: skip
        regular = np.abs(np.linalg.det(system)) > 1e-14
        solution = np.full(directions.shape, np.nan)
        right = np.broadcast_to(a, directions[regular].shape)[..., None]
        solution[regular] = np.linalg.solve(system[regular], right)[..., 0]
        t, v, w = solution.T
        hit = (t > 0.0) & (v >= 0.0) & (w >= 0.0) & (v + w <= 1.0)
        depths[hit] = np.minimum(depths[hit], t[hit])
    return depths


@pytest.mark.parametrize("seed", range(5))
def test_triangles_anywhere(seed):
    rng = np.random.default_rng(seed)
    triangles = rng.normal(0.0, 1.0, (40, 1, 3)) + rng.normal(0.0, 0.5, (40, 3, 3))
    triangles[::4, :, 2] += 3.0  # in front; the others behind and across, too
    raster = Raster(40, 30, 1.2)
    found, expected = raster.depths(triangles), traced(raster.directions, triangles)
    assert (np.isfinite(found) != np.isfinite(expected)).mean() < 0.005  # at the edges: rounding
    both = np.isfinite(found) & np.isfinite(expected)
    assert both.any()
    near = np.isclose(found[both], expected[both], rtol=1e-6)
    assert near.mean() > 0.99


def test_a_wall_fills_the_image():
    raster = Raster(32, 24, 1.0)
    wall = np.array([[(-9.0, -9.0, 2.0), (9.0, -9.0, 2.0), (9.0, 9.0, 2.0)],
                     [(-9.0, -9.0, 2.0), (9.0, 9.0, 2.0), (-9.0, 9.0, 2.0)]])  # fmt: skip
    assert raster.depths(wall) == pytest.approx(2.0)
    box = box_surface(np.array((-0.2, -0.2, 1.0)), np.array((0.2, 0.2, 1.5))).triangles
    depths = raster.depths(np.concatenate((wall, box))).reshape(24, 32)
    assert depths[12, 16] == pytest.approx(1.0) and depths[0, 0] == pytest.approx(2.0)


def test_nothing_is_seen_of_nothing():
    assert np.isinf(Raster(8, 8, 1.0).depths(np.empty((0, 3, 3)))).all()


def test_what_is_behind_is_not_seen():
    behind = box_surface(np.array((-1.0, -1.0, -3.0)), np.array((1.0, 1.0, -1.0))).triangles
    assert np.isinf(Raster(8, 8, 1.0).depths(behind)).all()


def test_a_rod_is_as_thick_as_it_is():
    points = np.array([(-1.0, 0.0, 2.0), (0.0, 0.0, 2.0), (1.0, 0.0, 2.0)])
    triangles = tube(points, 0.1)
    away = np.linalg.norm(triangles[..., 1:] - (0.0, 2.0), axis=-1)
    assert np.isfinite(triangles).all()
    assert away == pytest.approx(0.1, abs=1e-12)


def test_balls():
    triangles = balls(np.array([(0.0, 0.0, 2.0), (1.0, 0.0, 2.0)]), 0.1)
    first = triangles[: len(triangles) // 2]
    assert np.linalg.norm(first - (0.0, 0.0, 2.0), axis=-1) == pytest.approx(0.1)
    assert len(balls(np.zeros((2, 3)), 0.0)) == 0
