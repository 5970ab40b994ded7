import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from deformable_manipulation.motion.bounded_motion import BoundedMotion

LOWER, UPPER = (-1.0, 0.0, 0.5), (1.0, 0.2, 2.0)
ROUNDING = 1e-9

limits = st.tuples(st.floats(0.01, 5.0), st.floats(0.05, 20.0), st.floats(1e-3, 0.1))
vector = st.tuples(*[st.floats(-1e6, 1e6)] * 3)
# What is asked for, and for how many cycles.
requests = st.lists(
    st.tuples(st.sampled_from(["towards", "along"]), vector, st.integers(1, 60)),
    min_size=1,
    max_size=6,
)


def follow(motion, requests, dt, position, velocity=(0.0, 0.0, 0.0)):
    """Positions and velocities of something whose commands act a cycle late."""
    position, velocity = np.array(position, dtype=float), np.array(velocity, dtype=float)
    positions, velocities = [position], [velocity]
    for kind, wanted, cycles in requests:
        for _ in range(cycles):
            command = np.array(getattr(motion, kind)(wanted, position, velocity))
            position = position + dt * velocity
            velocity = command
            positions.append(position)
            velocities.append(velocity)
    return np.array(positions), np.array(velocities)


@settings(max_examples=150, deadline=None)
@given(limits, requests)
def test_box_speed_and_acceleration_hold_whatever_is_asked(limits, requests):
    max_velocity, max_acceleration, dt = limits
    motion = BoundedMotion(LOWER, UPPER, max_velocity, max_acceleration, dt)
    positions, velocities = follow(motion, requests, dt, (0.3, 0.1, 1.0))
    assert (positions >= np.array(LOWER) - ROUNDING).all()
    assert (positions <= np.array(UPPER) + ROUNDING).all()
    assert np.abs(velocities).max() <= max_velocity * (1.0 + ROUNDING)
    assert np.abs(np.diff(velocities, axis=0)).max() <= max_acceleration * dt * (1.0 + ROUNDING)


@settings(max_examples=60, deadline=None)
@given(limits, st.tuples(*(st.floats(low, high) for low, high in zip(LOWER, UPPER))))
def test_arrives_without_overshoot_in_the_shortest_time(limits, target):
    max_velocity, max_acceleration, dt = limits
    motion = BoundedMotion(LOWER, UPPER, max_velocity, max_acceleration, dt)
    start = np.array((0.3, 0.1, 1.0))
    way = np.abs(target - start).max()
    # At the speed allowed, with the two changes of speed; a cycle each for delay and rounding up.
    ramp = max_velocity / max_acceleration
    fastest = (
        way / max_velocity + ramp
        if way > ramp * max_velocity
        else 2.0 * np.sqrt(way / max_acceleration)
    )
    cycles = int(fastest / dt) + 4
    if cycles > 5000:
        return
    positions, velocities = follow(motion, [("towards", target, cycles)], dt, start)
    np.testing.assert_allclose(positions[-1], target, atol=ROUNDING)
    np.testing.assert_allclose(velocities[-1], 0.0, atol=ROUNDING / dt)
    done = (positions - start) * np.sign(target - start)
    assert (np.diff(done, axis=0) >= -ROUNDING).all()
    assert (done <= np.abs(target - start) + ROUNDING).all()


@pytest.mark.parametrize("kind, wanted", [("towards", (0.0, 9.0, 1.0)), ("along", (0.0, 9.0, 0.0))])
def test_what_is_out_of_the_box_is_held_at_its_wall(kind, wanted):
    motion = BoundedMotion(LOWER, UPPER, 0.2, 0.5, 0.01)
    positions, velocities = follow(motion, [(kind, wanted, 300)], 0.01, (0.0, 0.1, 1.0))
    assert positions[-1] == pytest.approx((0.0, UPPER[1], 1.0), abs=ROUNDING)
    assert velocities[-1] == pytest.approx(0.0, abs=1e-6)


def test_comes_back_from_outside_and_from_too_fast():
    motion = BoundedMotion(LOWER, UPPER, 0.2, 0.5, 0.01)
    positions, velocities = follow(
        motion, [("along", (0.0, 0.0, 0.0), 1000)], 0.01, (0.9, -0.3, 1.0), (1.0, 0.0, 0.0)
    )
    assert np.abs(np.diff(velocities, axis=0)).max() <= 0.005 + ROUNDING
    assert LOWER[1] == pytest.approx(positions[-1][1], abs=ROUNDING)
    assert positions[:, 0].max() > UPPER[0]  # it could not stop in time
    assert positions[-1][0] == pytest.approx(UPPER[0], abs=ROUNDING)
