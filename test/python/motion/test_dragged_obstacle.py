import numpy as np
import pytest

from deformable_manipulation.motion.dragged_obstacle import REACH, DraggedObstacle
from deformable_manipulation.motion.steering import DRAG_TIMEOUT, DRAGGED, RESTING
from deformable_manipulation.scenario import load_scenario


class Clock:
    now = 7.0

    def __call__(self):
        return self.now


@pytest.fixture(scope="module")
def scenario():
    return load_scenario("rope_moving_obstacle")


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture
def dragged(scenario, clock):
    return DraggedObstacle(scenario.obstacles[0], scenario, clock)


def test_goes_where_it_is_dragged_slowly_and_stays_near(dragged, scenario):
    start = np.array(scenario.obstacles[0].translation)
    places = [start]
    for _ in range(2000):
        dragged.drag(start + (0.2, 0.0, 9.0))
        dragged.advance()
        places.append(dragged.position)
    np.testing.assert_allclose(places[-1], start + (0.2, 0.0, REACH), atol=1e-9)
    velocities = np.diff(places, axis=0) / scenario.cycle_time
    assert np.abs(velocities).max() <= scenario.leader.max_velocity + 1e-9
    accelerations = np.diff(velocities, axis=0) / scenario.cycle_time
    assert np.abs(accelerations).max() <= scenario.leader.max_acceleration + 1e-6


def test_stops_when_nobody_holds_it_and_comes_back_with_a_reset(dragged, scenario, clock):
    start = np.array(scenario.obstacles[0].translation)
    for _ in range(100):
        dragged.drag(start + (0.0, 0.0, 0.5))
        dragged.advance()
    assert dragged.source == DRAGGED
    clock.now += DRAG_TIMEOUT + 0.1
    assert dragged.source == RESTING
    for _ in range(100):
        before = dragged.position
        dragged.advance()
    assert dragged.position == before
    assert 0.0 < before[2] - start[2] < 0.5
    dragged.reset()
    assert dragged.position == tuple(start)
