"""What has come of a live obstacle: hold, what is left out, faults."""

import numpy as np
import pytest
from seeing_builders import seen_block

from deformable_manipulation import _distance
from deformable_manipulation.seeing.carried_state import CarriedState, StateHistory
from deformable_manipulation.seeing.live_map import LiveMap, is_later
from deformable_manipulation.seeing.own_points import FrameUnknown

IDENTITY = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0)
TURNED = (0.0, 0.0, 3.0), (1.0, 0.0, 0.0, 0.0)  # half a turn about the x axis
ROPE = np.column_stack((np.zeros(29), np.linspace(0.0, 1.5, 29), np.full(29, 1.0)))
STATE = CarriedState(0.0, ROPE, ROPE[[0, -1]], np.array([(0.0, 0.0, 0.0, 1.0)] * 2))


def live_map(**changes):
    return LiveMap(seen_block(obstacles__1__least_points=1, **changes), 1)


def floor(height, count=20):
    x, y = np.meshgrid(np.linspace(-0.5, 0.5, count), np.linspace(0.0, 1.5, count))
    return np.column_stack((x.ravel(), y.ravel(), np.full(x.size, height)))


def take(made, time, points, pose=IDENTITY, find_frame=None, copies=None):
    made.take(time, np.asarray(points), pose, STATE._replace(time=time), find_frame, copies)


def lowest(made, copies=1):
    distance = _distance.MinimumDistance([made.seen.obstacle()], 0.0, 0.0)
    return distance.compute(np.repeat(ROPE[None], copies, axis=0)).minimum[0]


def test_points_are_where_their_frame_is():
    made = live_map()
    take(made, 0.0, floor(2.5) * (1.0, -1.0, 1.0), TURNED)  # 3 m - 2.5 m: half a metre above 0
    assert lowest(made) == pytest.approx(0.5 - 0.005, abs=0.01)
    assert made.seen.places[-1][:, 2] == pytest.approx(0.5)


def test_what_vanished_stays_for_the_hold_time():
    made = live_map(obstacles__1__hold=0.2)
    take(made, 0.0, floor(0.8))
    take(made, 0.1, floor(0.5))
    assert lowest(made) == pytest.approx(0.2 - 0.005, abs=0.01)
    take(made, 0.2, floor(0.5))
    assert len(made.seen.places) == 3
    take(made, 0.25, floor(0.5))
    assert lowest(made) == pytest.approx(0.5 - 0.005, abs=0.01)


def test_without_hold_only_the_newest_counts():
    made = live_map(obstacles__1__hold=0.0)
    take(made, 0.0, floor(0.8))
    take(made, 0.01, floor(0.5))
    assert lowest(made) == pytest.approx(0.5 - 0.005, abs=0.01)


def test_what_is_held_has_an_end():
    made = live_map(obstacles__1__hold=5.0)
    for k in range(100):
        take(made, 0.001 * k, floor(0.5, 3))
    assert len(made.seen.places) == 32


def test_time_that_was_set_back_takes_what_was_held_away():
    made = live_map(obstacles__1__hold=5.0)
    take(made, 10.0, floor(0.8))
    take(made, 1.0, floor(0.5))
    assert len(made.seen.places) == 1


def test_an_obstacle_that_is_prepared_is_the_same():
    made = live_map()
    take(made, 0.0, floor(0.7), copies=np.repeat(ROPE[None], 3, axis=0))
    assert lowest(made, 3) == lowest(made, 3)  # the first was prepared, the second was not


def test_the_object_and_the_grips_are_left_out():
    near_rope, near_grip = (0.03, 0.7, 1.0), (0.0, -0.044, 1.0)
    beside = [(0.045, 0.7, 1.0), (0.0, -0.05, 1.0), (0.0, 0.7, 0.95)]
    made = live_map()
    take(made, 0.0, [near_rope, near_grip, (np.nan, 0.0, 0.0), *beside])
    np.testing.assert_allclose(made.seen.places[-1], beside)


CAMERA = (0.0, 0.7, 3.0), (1.0, 0.0, 0.0, 0.0)  # looks straight down, 2 m over the rope
NOISY = {"obstacles__1__noise": 0.004, "obstacles__1__leave_out": {"object": 0.01, "grips": 0.03}}


def seen_from_above(*places):
    """A row of an image by the camera above, of places in the fixed frame, and an empty row."""
    row = (np.array(places) - CAMERA[0]) * (1.0, -1.0, -1.0)
    return np.stack((row, np.full_like(row, np.nan)))


def test_what_noise_has_moved_away_from_a_grip_is_left_out():
    kept = [(0.0, 0.0, 1.115), (0.04, 0.0, 1.0), (0.0, 0.7, 1.07)]  # 5 deviations: 80 mm
    moved = [(0.0, 0.0, 1.08), (0.02, 0.0, 1.06), (0.0, 0.7, 1.045), (0.0, 0.7, 0.955)]
    made = live_map(**NOISY)
    take(made, 0.0, seen_from_above(*kept, *moved), CAMERA)
    np.testing.assert_allclose(made.seen.places[-1], kept, atol=1e-12)
    made = live_map(**{**NOISY, "obstacles__1__noise": 0.0})
    take(made, 0.0, seen_from_above(*kept, *moved), CAMERA)
    assert len(made.seen.places[-1]) == len(kept) + len(moved)


def test_noise_is_smoothed():
    v, u = np.mgrid[-0.3:0.3:40j, -0.3:0.3:40j]
    true = 2.5 * np.stack((u, v, np.ones_like(u)), axis=-1)
    noise = 1.0 + 0.004 * 2.5 * np.random.default_rng(0).standard_normal(u.shape)
    made = live_map(**NOISY)
    take(made, 0.0, true * noise[:, :, None], CAMERA)
    assert 0.5 - 0.005 - lowest(made) < 0.03  # of a deviation of 25 mm
    rough = live_map(**{**NOISY, "obstacles__1__noise": 0.0})
    take(rough, 0.0, true * noise[:, :, None], CAMERA)
    assert 0.5 - 0.005 - lowest(rough) > 0.05


@pytest.mark.parametrize(
    "points, complaint",
    [
        (floor(0.5), "it has no rows of points, as of an image, which `noise` needs"),
        (
            floor(0.5).reshape(20, 20, 3) - (0, 0, 1),
            "it has points behind the camera; `noise` needs",
        ),
    ],
)
def test_noise_needs_an_image(points, complaint):
    made = live_map(**NOISY)
    with pytest.raises(ValueError, match=complaint):
        take(made, 0.0, points)
    assert made.seen is None


def test_shapes_of_a_robot_are_left_out():
    shape = {"start": [0, 0, 0.1], "end": [0, 0, 0.5], "radius": 0.05}
    on_agent = {"frame": "assistant_1", **shape}
    made = live_map(obstacles__1__leave_out={"shapes": [on_agent, {"frame": "elbow", **shape}]})
    points = [(0.0, 1.5, 1.3), (0.04, 1.5, 1.5), (0.0, 1.5, 1.56), (1.0, 1.0, 1.3)]
    elbow = (1.0, 1.0, 1.0), (0.0, 0.0, 0.0, 1.0)
    take(made, 0.0, points, find_frame=lambda name, time: elbow if name == "elbow" else None)
    np.testing.assert_allclose(made.seen.places[-1], points[2:3])
    with pytest.raises(FrameUnknown, match="the frame 'elbow' of a shape to be left out is not"):
        take(made, 1.0, points, find_frame=lambda name, time: None)
    take(made, 2.0, points)  # without tf there are no robots
    assert len(made.seen.places[-1]) == 2


@pytest.mark.parametrize("points", [np.full((50, 3), np.nan), np.empty((0, 3))])
def test_data_without_points_change_nothing(points):
    made = live_map()
    take(made, 0.0, floor(0.5))
    seen = made.seen
    with pytest.raises(ValueError, match="it has 0 points of which something can be made; 1 at"):
        take(made, 0.1, points)
    assert made.seen is seen


def test_nothing_may_be_there_if_that_is_said():
    made = LiveMap(seen_block(obstacles__1__least_points=0), 1)
    take(made, 0.0, np.full((50, 3), np.nan))
    assert lowest(made) == np.inf


def test_faults():
    made = live_map(obstacles__1__timeout=0.5)
    assert made.fault(0.0) == "nothing has come yet"
    take(made, 1.0, floor(0.5))
    assert made.fault(1.5) == ""
    assert made.fault(1.6) == "nothing that can be used has come for 0.6 s"
    assert "0.6 s in the future; synchronise the clocks" in made.fault(0.4)
    made.forget()
    assert made.fault(1.0) == "nothing has come yet"


@pytest.mark.parametrize(
    "time, before, later",
    [(1.0, 0.9, True), (0.9, 0.9, False), (0.8, 0.9, False), (0.1, 0.9, True), (0, -np.inf, True)],
)
def test_the_order_of_data(time, before, later):
    assert is_later(time, before, 0.5) == later


def test_the_state_of_a_time():
    history = StateHistory()
    assert history.at(1.0) is None
    for time in (1.0, 1.1, 1.2):
        history.add(STATE._replace(time=time))
    assert history.at(1.12).time == 1.1 and history.at(9.0).time == 1.2
    history.add(STATE._replace(time=0.5))  # set back
    assert history.at(9.0).time == 0.5


def cells(centres):
    changes = {"obstacles__1": {"name": "map", "live_voxels": "centres", "size": 0.1,
                                "leave_out": {"object": 0.01}}}  # fmt: skip
    made = LiveMap(seen_block(**changes), 1)
    take(made, 0.0, centres)
    return made


def test_voxels_are_cubes():
    centres = floor(0.45, 1) + (0.5, 0.0, 0.0) + [(0.1 * k + 0.05, 0.75, 0.0) for k in range(-3, 3)]
    made = cells(centres)
    assert lowest(made) == pytest.approx(0.5, abs=1e-6)
    inside = ROPE - (0.0, 0.0, 0.55)  # through the middles: 0.05 deep
    distance = _distance.MinimumDistance([made.seen.obstacle()], 0.0, 0.0)
    assert distance.compute(inside[None]).minimum[0] == pytest.approx(-0.05, abs=1e-6)


def test_voxels_of_another_size_are_refused():
    with pytest.raises(ValueError, match="is not the middle of a cell of 0.1 m"):
        cells([(0.5, 0.5, 0.03)])


def test_a_field():
    changes = {"obstacles__1": {"name": "map", "live_field": "esdf", "spacing": 0.1,
                                "unknown": "free"}}  # fmt: skip
    made = LiveMap(seen_block(**changes), 1)
    line = np.arange(-0.5, 2.0, 0.1)
    places = np.stack(np.meshgrid(line, line, line, indexing="ij"), axis=-1).reshape(-1, 3)
    take(made, 0.0, np.column_stack((places, places[:, 2] - 0.3)))
    assert lowest(made) == pytest.approx(0.7, abs=1e-5)
