import numpy as np
import pytest

from deformable_manipulation._control import PositionFilter

CYCLE = 0.01  # s


def fed(time_constant, positions, cycle=CYCLE):
    result = PositionFilter(time_constant)
    for index, position in enumerate(positions):
        assert result.update(index * cycle, position)
    return result


def test_constant_velocity_is_followed_and_predicted_without_lag():
    velocity = np.array([[0.1, -0.2, 0.05], [0.0, 0.3, -0.1]])
    result = fed(0.1, [index * CYCLE * velocity for index in range(500)])
    np.testing.assert_allclose(result.velocity(), velocity, atol=1e-12)
    np.testing.assert_allclose(result.position(5.05), 5.05 * velocity, atol=1e-12)


def test_a_motion_that_is_under_way_is_followed_at_once():
    result = fed(0.2, [np.full(3, 1.0 + 0.15 * index * CYCLE) for index in range(3)])
    np.testing.assert_allclose(result.velocity(), 0.15, rtol=1e-12)
    np.testing.assert_allclose(result.position(1.0), 1.15, rtol=1e-12)


def test_the_first_measurements_are_fitted_by_a_line_of_least_squares():
    noisy = np.random.default_rng(2).standard_normal((6, 1))
    result = fed(10.0, noisy)
    slope, start = np.polyfit(CYCLE * np.arange(6), noisy[:, 0], 1)
    assert result.velocity()[0] == pytest.approx(slope, rel=1e-9)
    assert result.position(0.0)[0] == pytest.approx(start, rel=1e-9)


def test_without_a_time_constant_measurements_and_their_differences_pass():
    result = fed(0.0, [np.zeros(3), np.full(3, 0.001)])
    np.testing.assert_allclose(result.position(CYCLE), np.full(3, 0.001), rtol=1e-15)
    np.testing.assert_allclose(result.velocity(), np.full(3, 0.1), rtol=1e-15)


@pytest.mark.parametrize("time_constant", [0.1, 0.5])
def test_an_acceleration_leaves_the_stated_lag(time_constant):
    times = CYCLE * np.arange(1000)
    result = fed(time_constant, [np.array([0.5 * t * t]) for t in times])
    lag = 0.5 * times[-1] ** 2 - result.position(times[-1])[0]
    assert lag == pytest.approx(time_constant**2, rel=0.15)
    assert times[-1] - result.velocity()[0] == pytest.approx(2.0 * time_constant, rel=0.15)


def test_white_noise_leaves_the_stated_parts():
    time_constant = 0.2
    noise = np.random.default_rng(1).standard_normal((1000, 2000))
    result = fed(time_constant, noise)
    ratio = CYCLE / time_constant
    position = result.position(999 * CYCLE).std()
    assert position == pytest.approx(1.1 * ratio**0.5, rel=0.1)
    assert result.velocity().std() == pytest.approx(0.5 / CYCLE * ratio**1.5, rel=0.1)


def test_what_is_late_or_not_finite_is_refused():
    result = fed(0.1, [np.zeros(3), np.zeros(3)])
    for time, value in ((CYCLE, 1.0), (0.5 * CYCLE, 1.0), (np.nan, 0.0), (1.0, np.inf)):
        assert not result.update(time, np.full(3, value))
    np.testing.assert_array_equal(result.position(1.0), np.zeros(3))


@pytest.mark.parametrize("time_constant", [-0.1, np.nan, np.inf])
def test_impossible_time_constants_are_refused(time_constant):
    with pytest.raises(ValueError, match="time constant"):
        PositionFilter(time_constant)


def test_needs_a_position():
    with pytest.raises(RuntimeError, match="update"):
        PositionFilter(0.1).velocity()
