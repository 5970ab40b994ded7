import numpy as np
import pytest

from deformable_manipulation._control import VelocityEstimator


def fed(stamps, positions, **settings):
    estimator = VelocityEstimator(**settings)
    for stamp, position in zip(stamps, positions):
        estimator.update(stamp, position)
    return estimator


def test_constant_velocity_is_exact():
    velocity = np.array([0.1, -0.2, 0.05])
    estimator = fed([0.0, 0.01, 0.03], [t * velocity for t in (0.0, 0.01, 0.03)])
    np.testing.assert_allclose(estimator.velocity(), velocity, atol=1e-14)


def test_is_zero_before_two_positions():
    estimator = fed([0.0], [np.ones((2, 3))])
    np.testing.assert_array_equal(estimator.velocity(), np.zeros((2, 3)))


def test_needs_a_position():
    with pytest.raises(RuntimeError, match="update"):
        VelocityEstimator().velocity()


def test_repeated_and_late_stamps_are_ignored():
    estimator = fed([0.0, 0.01], [np.zeros(3), np.full(3, 0.001)])
    assert not estimator.update(0.01, np.full(3, 7.0))
    assert not estimator.update(0.005, np.full(3, 7.0))
    assert not estimator.update(0.01 + 1e-9, np.full(3, 7.0))
    np.testing.assert_allclose(estimator.velocity(), np.full(3, 0.1))
    assert estimator.update(0.02, np.full(3, 0.002))
    np.testing.assert_allclose(estimator.velocity(), np.full(3, 0.1))


@pytest.mark.parametrize("stamp, value", [(np.nan, 0.0), (np.inf, 0.0), (0.02, np.nan)])
def test_what_is_not_finite_is_ignored(stamp, value):
    estimator = fed([0.0, 0.01], [np.zeros(3), np.full(3, 0.001)])
    assert not estimator.update(stamp, np.full(3, value))
    assert estimator.update(0.02, np.full(3, 0.002))
    np.testing.assert_allclose(estimator.velocity(), np.full(3, 0.1))


def test_time_set_back_starts_afresh():
    estimator = fed([5.0, 5.01], [np.zeros(3), np.ones(3)], jump_back=0.2)
    assert estimator.update(0.0, np.zeros(3))
    np.testing.assert_array_equal(estimator.velocity(), np.zeros(3))
    assert estimator.update(0.01, np.full(3, 0.001))
    np.testing.assert_allclose(estimator.velocity(), np.full(3, 0.1))


def test_keeps_its_own_copy_of_the_position():
    position = np.zeros(3)
    estimator = fed([0.0], [position])
    position[:] = 1.0
    estimator.update(0.01, np.full(3, 0.001))
    np.testing.assert_allclose(estimator.velocity(), np.full(3, 0.1))
