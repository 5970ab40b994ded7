"""Cubes side by side as one solid: against each cube by itself."""

import mesh_reference
import numpy as np
import pytest

from deformable_manipulation import _distance

SIZE = 0.25  # m
PADDING = 8  # cells around, of the reference


def calculator(cells, endless=False, margin=0.0, band=0.3):
    cells = np.asarray(cells, dtype=np.int32)
    obstacle = _distance.MeshObstacle.of_cells(cells, SIZE, endless)
    return _distance.MinimumDistance([obstacle], margin, band)


def to_cubes(points, cells):
    """Distances (K,) of points (K, 3) to the nearest of cubes (N, 3)."""
    beyond = np.abs(points[:, None] - SIZE * (cells + 0.5)) - 0.5 * SIZE
    return np.linalg.norm(np.maximum(beyond, 0.0), axis=2).min(axis=1)


def signed_distances(points, cells, endless=False):
    """Outside, to the nearest cube; inside, to the nearest one that is not filled."""
    low, high = cells.min(axis=0) - PADDING, cells.max(axis=0) + PADDING + 1
    ranges = [np.arange(a, b) for a, b in zip(low, high)]
    everything = np.stack(np.meshgrid(*ranges), axis=-1).reshape(-1, 3)
    known = set(map(tuple, cells))
    others = np.array([cell for cell in map(tuple, everything) if cell not in known])
    signed = np.where(
        [tuple(cell) in known for cell in np.floor(points / SIZE).astype(int)],
        -to_cubes(points, others),
        to_cubes(points, cells),
    )
    return -signed if endless else signed


def random_cells(rng, side=4, share=0.4):
    filled = rng.random((side, side, side)) < share
    filled[1, 2, 3 % side] = True
    return np.argwhere(filled) + rng.integers(-3, 3, 3)


BLOCK = np.argwhere(np.ones((3, 4, 5)))
SHELL = np.argwhere(np.pad(np.zeros((3, 3, 3)), 1, constant_values=1))
DIAGONAL = np.array([(0, 0, 0), (1, 1, 0), (2, 2, 1)])  # edges and corners that touch
ONE = np.zeros((1, 3), dtype=int)


def all_cells():
    yield from (BLOCK, SHELL, DIAGONAL, ONE)
    yield from (random_cells(np.random.default_rng(seed)) for seed in range(6))


@pytest.mark.parametrize("endless", [False, True])
@pytest.mark.parametrize("cells", all_cells())
def test_points(cells, endless):
    rng = np.random.default_rng(1)
    middle = SIZE * (cells.mean(axis=0) + 0.5)
    points = middle + 0.6 * rng.normal(size=(150, 3))
    points[::3] = SIZE * np.round(points[::3] / SIZE) + rng.normal(size=points[::3].shape) * 1e-3
    copies = np.stack((points, points + 1e-9), axis=1)
    found = calculator(cells, endless).compute(copies).minimum
    expected = signed_distances(points, cells, endless)
    outside = expected > -1e-5
    assert found[outside] == pytest.approx(expected[outside], abs=1e-8)
    assert found[~outside] == pytest.approx(expected[~outside], abs=1.2e-5)


@pytest.mark.parametrize("is_surface", [False, True])
@pytest.mark.parametrize("endless", [False, True])
@pytest.mark.parametrize("cells", list(all_cells())[1:7])
def test_elements(cells, endless, is_surface):
    rng = np.random.default_rng(2)
    for size in (0.1, 0.6):
        middle = SIZE * (cells.mean(axis=0) + 0.5) + 0.3 * rng.normal(size=3)
        points, triangles = mesh_reference.sheet(rng, cells=2, size=size, middle=middle)
        elements = triangles if is_surface else np.array([(i, i + 1, i + 1) for i in range(8)])
        found = calculator(cells, endless).compute(points[None], triangles if is_surface else None)
        bounds = _bounds(cells, endless, points[elements])
        assert found.minimum[0] <= bounds[:, 1].min() + 1.2e-5
        assert found.minimum[0] >= bounds[:, 0].min() - 1.2e-5
        for distance, vertices in zip(found.distance, found.vertices):
            of = np.flatnonzero((np.sort(elements, axis=1) == np.sort(vertices)).all(axis=1))
            assert bounds[of, 0].min() - 1.2e-5 <= distance <= bounds[of, 1].max() + 1.2e-5
        places = found.object_point
        at = signed_distances(places, cells, endless)
        assert at == pytest.approx(found.distance, abs=1.2e-5)


def _bounds(cells, endless, corners, count=12):
    """Between which two values (E, 2) [m] each element's least signed distance is."""
    grid = [(i, j, count - i - j) for i in range(count + 1) for j in range(count + 1 - i)]
    samples = np.einsum("kw,ewd->ekd", np.array(grid) / count, corners)
    signed = signed_distances(samples.reshape(-1, 3), cells, endless).reshape(len(corners), -1)
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    return np.stack((signed.min(axis=1) - longest / count, signed.min(axis=1)), axis=1)


def test_an_object_far_in_unknown_space_is_driven_to_where_it_is_free():
    """It is beyond the box around all free cells."""
    line = np.array([(0.1, 0.1, 5.0), (0.2, 0.1, 5.0)])
    found = calculator(BLOCK, endless=True).compute(line[None])
    assert found.minimum[0] == pytest.approx(5 * SIZE - 5.0, abs=1.2e-5)
    assert found.normal[0] == pytest.approx((0.0, 0.0, -1.0), abs=1e-6)


def test_repeated_cells_are_one():
    line = np.array([(0.1, 0.1, 0.5), (0.2, 0.1, 0.5)])
    twice = np.concatenate((ONE, ONE))
    found = calculator(twice).compute(line[None])
    assert found.minimum[0] == pytest.approx(0.25)


@pytest.mark.parametrize(
    "cells, size, told",
    [
        (np.zeros((0, 3)), 0.1, "there is no cube"),
        (np.full((1, 3), 2**20), 0.1, "cube 0 is too far away"),
        (np.zeros((1, 3)), 0.0, "size is 0"),
        (np.zeros((1, 3)), np.nan, "size is nan"),
        (np.zeros((1, 2)), 0.1, "shape .cells, 3."),
    ],
)
def test_cells_refused(cells, size, told):
    with pytest.raises(ValueError, match=told):
        _distance.MeshObstacle.of_cells(cells.astype(np.int32), size)
