"""The simulated camera, and runs whose controllers see through it."""

import dataclasses

import numpy as np
import pytest
from seeing_builders import seen_block

from deformable_manipulation.control.status import Status
from deformable_manipulation.geometry.rotation import rotate
from deformable_manipulation.obstacles.spec import placed
from deformable_manipulation.running.closed_loop import ClosedLoop
from deformable_manipulation.running.inspection import inspect_scenario
from deformable_manipulation.seeing.camera_times import CameraTimes
from deformable_manipulation.seeing.carried_state import CarriedState
from deformable_manipulation.seeing.depth_camera import DepthCamera, camera_axes, camera_rotation

CLEAN = {"camera__noise": 0.0, "camera__holes": 0.0}
UPRIGHT = np.array([(0.0, 0.0, 0.0, 1.0)] * 2)


def state_of(scenario, away=9.0):
    points = np.column_stack((np.full(29, away), np.linspace(0.0, 1.5, 29), np.full(29, 1.0)))
    return CarriedState(0.0, points, points[[0, -1]], UPRIGHT)


def seen_points(scenario, cycle=0, state=None):
    """In the fixed frame, those that are there (N, 3) [m]."""
    image = DepthCamera(scenario).image(cycle, state or state_of(scenario))
    points = image[np.isfinite(image).all(axis=2)].astype(float)
    return points @ camera_axes(scenario.camera).T + scenario.camera.position


def on_box(points, obstacle):
    """How far (N,) [m] points are from the surface of a box along its axes."""
    half = 0.5 * np.array(obstacle.box.size)
    away = np.abs(points - obstacle.translation) - half
    outside = np.linalg.norm(np.maximum(away, 0.0), axis=1)
    return np.abs(outside + np.minimum(away.max(axis=1), 0.0))


def test_points_are_on_the_obstacle_where_it_faces_the_camera():
    scenario = seen_block(**CLEAN)
    points, block = seen_points(scenario), scenario.obstacles[0]
    assert len(points) > 200
    assert on_box(points, block) == pytest.approx(0.0, abs=1e-6)
    assert (points[:, 0] > -0.1499).all()  # the far side is hidden


def test_noise_grows_with_the_square_of_the_depth():
    clean, noisy = (
        DepthCamera(each).image(0, state_of(each))[:, :, 2]
        for each in (seen_block(**CLEAN), seen_block(camera__noise=0.01, camera__holes=0.0))
    )
    there = np.isfinite(clean) & np.isfinite(noisy)
    relative = (noisy[there] - clean[there]) / (0.01 * clean[there] ** 2)
    assert relative.std() == pytest.approx(1.0, abs=0.1)


def test_holes():
    full, holed = (
        len(seen_points(seen_block(camera__noise=0.0, camera__holes=share))) for share in (0.0, 0.3)
    )
    assert holed / full == pytest.approx(0.7, abs=0.1)


def test_the_same_cycle_has_the_same_image():
    scenario = seen_block()
    camera, other = DepthCamera(scenario), DepthCamera(scenario)
    first = camera.image(7, state_of(scenario))
    camera.image(8, state_of(scenario))
    np.testing.assert_array_equal(other.image(7, state_of(scenario)), first)
    assert not np.array_equal(camera.image(8, state_of(scenario)), first, equal_nan=True)


def test_the_rope_and_the_grips_are_seen():
    scenario = seen_block(**CLEAN)
    state = state_of(scenario, away=0.0)
    points = seen_points(scenario, state=state)
    grips = np.linalg.norm(points[:, None] - state.positions, axis=2).min(axis=1)
    assert (np.abs(grips - 0.03) < 0.01).sum() > 5


def test_a_moving_obstacle_is_seen_where_it_is():
    motion = {"waypoints": [{"time": 0.0}, {"time": 1.0, "position": [0.0, 0.2, 0.0]}]}
    scenario = seen_block(obstacles__0__motion=motion, **CLEAN)
    block = scenario.obstacles[0]
    moved = block.at((0.0, 1.0, 0.25), block.rotation)
    assert on_box(seen_points(scenario, 100), moved) == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("target", [(0.0, 0.75, 0.4), (1.4, 5.0, 1.2), (-3.0, -2.0, 9.0)])
def test_the_camera_s_orientation(target):
    camera = dataclasses.replace(seen_block().camera, target=target)
    axes = np.array([rotate(camera_rotation(camera), tuple(axis)) for axis in np.eye(3)]).T
    assert axes == pytest.approx(camera_axes(camera), abs=1e-12)
    assert axes[2, 1] <= 0.0  # its y axis points down


def test_images_come_at_their_rate():
    times = CameraTimes(seen_block(camera__rate=15.0))
    due = [cycle for cycle in range(1000) if times.is_due(cycle)]
    assert len(due) == 150 and due[:3] == [0, 7, 14]
    assert [times.last_before(cycle) for cycle in (0, 1, 7, 8)] == [None, 0, 0, 7]
    everywhere = CameraTimes(seen_block(camera__rate=100.0))
    assert all(everywhere.is_due(cycle) for cycle in range(1000))


@pytest.fixture(scope="module")
def records():
    loop = ClosedLoop(seen_block())
    return [loop.step() for _ in range(600)]


def test_the_assistant_waits_for_the_first_image_and_follows_then(records):
    statuses = [record.decisions["assistant_1"].status for record in records]
    assert statuses[0] == Status.WAITING
    assert Status.WAITING not in statuses[1:]


def test_the_true_distance_is_kept(records):
    lowest = min(record.distance for record in records)
    assert 0.05 <= lowest < 0.075


def test_without_seeing_it_would_not_be():
    loop = ClosedLoop(seen_block(obstacles__1__live_cloud="elsewhere"))
    assert min(loop.step().distance for _ in range(600)) < 0.0


def run_with_noise(known):
    """How many programs are relaxed, and the least true distance [m]."""
    near = {"object": 0.015, "grips": 0.035}
    changes = {"obstacles__1__noise": known, "obstacles__1__leave_out": near}
    scenario = seen_block(camera__noise=0.003, **changes)
    loop = ClosedLoop(scenario)
    records = [loop.step() for _ in range(scenario.cycles)]
    relaxed = [record.decisions["assistant_1"].status == Status.RELAXED for record in records]
    return sum(relaxed), min(record.distance for record in records)


def test_noise_that_is_known_does_not_make_the_assistant_flee():
    relaxed, least = run_with_noise(0.003)
    relaxed_without, least_without = run_with_noise(0.0)
    assert relaxed < 0.2 * relaxed_without
    assert 0.05 < least < least_without - 0.005  # no farther than needed, and not too near


def test_what_nobody_knows_is_no_obstacle_to_the_controllers(records):
    assert records[300].decisions["assistant_1"].distance != records[300].distance


def test_a_camera_that_sees_nothing_stops_the_assistant():
    loop = ClosedLoop(seen_block(camera__nearest=5.0, camera__farthest=6.0))
    decisions = [loop.step().decisions["assistant_1"] for _ in range(20)]
    assert {each.status for each in decisions} == {Status.WAITING}
    reason = decisions[-1].reason
    assert reason in decisions[-1].text
    assert "obstacle 'seen' is lost: nothing has come yet on camera/points" in reason
    assert "it has 0 points of which something can be made; 100 at least are needed" in reason
    assert "change the camera's position, target, nearest or farthest" in reason


def test_the_drawn_obstacle_is_the_one_that_is_seen():
    """Guards the tests above: the box of on_box is where the scenario puts it."""
    block = seen_block().obstacles[0]
    corners = placed(block, block.drawing().triangles).reshape(-1, 3)
    assert on_box(corners, block) == pytest.approx(0.0, abs=1e-9)


def h_at_the_start(scenario):
    facts = inspect_scenario(scenario).facts
    (line,) = (each for each in facts if each.startswith("barrier collision"))
    return line.split("h at the start: ")[1]


def test_a_check_tells_h_as_the_assistant_knows_it():
    """Of the block, which is 0.95 m below the rope, the camera sees points; or nobody tells it."""
    real = inspect_scenario(seen_block()).facts
    distance = float(next(each for each in real if "from the obstacles" in each).split()[-2])
    seen = float(h_at_the_start(seen_block()).split()[-2])
    assert seen == pytest.approx(distance - 0.05, abs=0.05) and seen != distance - 0.05
    assert h_at_the_start(seen_block(obstacles__1__live_cloud="elsewhere")) == (
        "nothing to keep from"
    )


def test_a_check_warns_of_a_camera_that_sees_nothing():
    (warning,) = inspect_scenario(seen_block(camera__nearest=5.0, camera__farthest=6.0)).warnings
    assert warning.startswith("obstacle seen: the newest image is not used: it has 0 points")
    assert warning.endswith("The assistants stand still until it is seen")
