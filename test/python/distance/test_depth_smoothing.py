"""Depth images without the noise that their neighbours tell, against a plain implementation."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from deformable_manipulation import _distance

NOISE = 0.001  # m at 1 m
ROWS, COLUMNS = 40, 50


def plane(distance=2.0, tilt=(0.2, -0.6)):
    """Depths [m] of a plane in the pixels of a pinhole camera."""
    v, u = np.mgrid[:ROWS, :COLUMNS] * 0.006
    return distance / (1.0 + tilt[0] * u + tilt[1] * v)


def noisy(depths, seed=0):
    random = np.random.default_rng(seed)
    return (depths + NOISE * depths**2 * random.standard_normal(depths.shape)).astype(np.float32)


def smooth(depths):
    return depths * _distance.smoothing_factors(depths, NOISE)


def in_noise(found, true):
    """How far depths are off, in standard deviations."""
    return (found - true) / (NOISE * true**2)


def expected_factor(depths, row, column):
    """Of a pixel, by least squares over those around it."""
    rows = np.arange(max(row - 2, 0), min(row + 3, ROWS))
    columns = np.arange(max(column - 2, 0), min(column + 3, COLUMNS))
    v, u = (axis.ravel() for axis in np.meshgrid(rows - row, columns - column, indexing="ij"))
    around = depths[row + v, column + u].astype(float)
    known = np.isfinite(around) & (around > 0.0) & ((u != 0) | (v != 0))
    own = float(depths[row, column])
    if not (np.isfinite(own) and own > 0.0) or known.sum() < 12:
        return 1.0
    design = np.column_stack((np.ones(known.sum()), u[known], v[known]))
    if np.linalg.matrix_rank(design) < 3:
        return 1.0
    values = 1.0 / around[known] - 1.0 / own
    found = np.linalg.lstsq(design, values, rcond=None)[0]
    doubt = np.linalg.inv(design.T @ design)[0, 0]
    variance = ((values - design @ found) ** 2).sum() / (len(values) - 3)
    if variance > 2.0 * NOISE**2 or doubt >= 0.5 or abs(found[0]) > 5.0 * NOISE:
        return 1.0
    return (1.0 / own) / (1.0 / own + found[0] / (1.0 + doubt))


@given(seed=st.integers(0, 2**31), holes=st.floats(0.0, 0.6), step=st.floats(0.0, 0.2))
@settings(max_examples=15, deadline=None)
def test_as_least_squares_say(seed, holes, step):
    random = np.random.default_rng(seed)
    true = plane()
    true[:, 20:] += step
    depths = noisy(true, seed)
    depths[random.random(depths.shape) < holes] = random.choice([np.nan, np.inf, 0.0, -1.0])
    found = _distance.smoothing_factors(depths, NOISE)
    expected = np.array(
        [[expected_factor(depths, row, column) for column in range(COLUMNS)] for row in range(ROWS)]
    )
    off = np.abs(found - expected) > 1e-4
    assert off.mean() < 2e-3  # one and the other side of a threshold, by rounding
    assert np.abs(found - expected).max() <= 5.1 * NOISE * np.nanmax(np.abs(true))


def test_the_noise_of_a_plane_becomes_a_fifth():
    true = plane()
    before, after = in_noise(noisy(true), true), in_noise(smooth(noisy(true)), true)
    assert before.std() == pytest.approx(1.0, abs=0.05)
    inner = after[2:-2, 2:-2]
    assert inner.std() == pytest.approx(0.2, abs=0.03)
    assert np.abs(inner.mean()) < 0.09  # four deviations of the mean of what noise there was
    assert np.abs(inner).max() < 0.5 * np.abs(before).max()


def test_what_stands_out_stays():
    true = plane()
    behind = true.copy()
    true[:, 25] -= 12.0 * NOISE * true[:, 25] ** 2  # a wire
    true[20, 10] -= 6.0 * NOISE * true[20, 10] ** 2  # a single pixel
    depths = noisy(true)
    depths[20, 10] = true[20, 10]
    found = smooth(depths)
    np.testing.assert_array_equal(found[:, 25], depths[:, 25])
    assert found[20, 10] == depths[20, 10]
    assert in_noise(found, behind)[:, 25].max() < -7.0


def test_no_pixel_moves_far():
    random = np.random.default_rng(3)
    depths = (2.0 + 0.02 * random.standard_normal((ROWS, COLUMNS))).astype(np.float32)
    moved = 1.0 / smooth(depths).astype(float) - 1.0 / depths.astype(float)
    assert np.abs(moved).max() <= 5.0 * NOISE + 1e-6


def test_pixels_without_a_depth_have_a_factor_of_1():
    depths = noisy(plane())
    depths[::2, ::3] = (np.nan,)
    factors = _distance.smoothing_factors(depths, NOISE)
    assert (factors[::2, ::3] == 1.0).all() and np.isfinite(factors).all()


@pytest.mark.parametrize("shape", [(0, 5), (1, 1), (1, 50), (5, 3), (3, 5)])
def test_small_images(shape):
    assert _distance.smoothing_factors(np.full(shape, 2.0), NOISE).shape == shape


@pytest.mark.parametrize(
    "depths, noise, complaint",
    [
        (np.ones(5), NOISE, "depths must have the shape"),
        (np.ones((5, 5)), 0.0, "noise must be a number above 0"),
        (np.ones((5, 5)), np.nan, "noise must be a number above 0"),
    ],
)
def test_wrong_arguments(depths, noise, complaint):
    with pytest.raises(ValueError, match=complaint):
        _distance.smoothing_factors(depths, noise)
