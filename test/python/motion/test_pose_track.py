"""An obstacle whose poses are measured."""

import math

import numpy as np
import pytest

from deformable_manipulation.geometry.rotation import from_vector, multiply
from deformable_manipulation.motion.pose_track import PoseTrack

TIMEOUT, PERIOD = 0.2, 0.01  # s
LINEAR, ANGULAR = np.array([0.1, -0.2, 0.05]), np.array([0.3, 0.1, -0.9])
TURNED = from_vector((2.0, 0.0, 2.0))
IDENTITY = (0.0, 0.0, 0.0, 1.0)


def pose_at(time):
    """Of constant velocities, from TURNED at the origin."""
    return (time * LINEAR).tolist(), multiply(from_vector(time * ANGULAR), TURNED)


@pytest.fixture
def track():
    return PoseTrack(TIMEOUT, 0.5 * PERIOD)


def feed(track, times, change=lambda pose: pose):
    return [track.update(time, *change(pose_at(time))) for time in times]


def test_it_knows_nothing_at_first(track):
    assert track.fault(1.0) == "no pose yet"


def test_pose_and_velocity_are_those_of_a_steady_motion(track):
    assert feed(track, np.arange(1.0, 1.5, PERIOD)) == 50 * [""]
    for now in (1.49, 1.5, 1.55):  # the newest pose is moved on
        pose = track.at(now)
        position, rotation = pose_at(now)
        np.testing.assert_allclose(pose.translation, position, atol=1e-9)
        assert abs(np.dot(pose.rotation, rotation)) == pytest.approx(1.0, abs=1e-9)
        np.testing.assert_allclose(pose.linear, LINEAR, atol=1e-9)
        np.testing.assert_allclose(pose.angular, ANGULAR, rtol=1e-4)
        assert track.fault(now) == ""


def test_the_sign_of_a_quaternion_makes_no_motion(track):
    signs = iter(50 * (1.0, -1.0))
    feed(
        track,
        np.arange(0.0, 0.3, PERIOD),
        lambda pose: (pose[0], np.multiply(next(signs), pose[1]).tolist()),
    )
    np.testing.assert_allclose(track.at(0.3).angular, ANGULAR, rtol=1e-4)


def test_the_first_pose_rests(track):
    feed(track, [3.0])
    assert track.at(3.1).linear == track.at(3.1).angular == (0.0, 0.0, 0.0)


def test_it_is_lost_after_the_timeout_and_found_again(track):
    feed(track, [1.0, 1.01])
    assert track.fault(1.01 + TIMEOUT - 1e-6) == ""
    assert track.fault(1.41) == "no pose for 0.4 s"
    assert "0.4 s in the future" in track.fault(0.61)
    feed(track, [1.4])
    assert track.fault(1.41) == ""


@pytest.mark.parametrize(
    "stamp, position, orientation, reason",
    [
        (math.nan, (0.0, 0.0, 0.0), IDENTITY, "not finite"),
        (2.0, (0.0, math.inf, 0.0), IDENTITY, "not finite"),
        (2.0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, math.nan), "not finite"),
        (2.0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0), "norm 0"),
        (2.0, (0.0, 0.0, 0.0), (1.0, 1.0, 0.0, 0.0), "norm 1.414"),
    ],
)
def test_what_is_no_pose_is_dropped(track, stamp, position, orientation, reason):
    feed(track, [1.0, 1.01])
    before = track.at(1.02)
    assert reason in track.update(stamp, position, orientation)
    assert track.at(1.02) == before


@pytest.mark.parametrize("stamp", [1.01, 1.0, 0.95, 1.014])
def test_duplicates_and_late_poses_change_nothing(track, stamp):
    feed(track, [1.0, 1.01])
    before = track.at(1.02)
    assert track.update(stamp, (9.0, 9.0, 9.0), IDENTITY) == ""
    assert track.at(1.02) == before


def test_a_clock_that_was_set_back_starts_afresh(track):
    feed(track, [100.0, 100.01])
    feed(track, [1.0])
    assert track.fault(1.0) == "" and track.at(1.0).linear == (0.0, 0.0, 0.0)


@pytest.mark.parametrize(
    "position, rotation", [((1.0, 0.0, 0.0), TURNED), ((0.001, 0.0, 0.0), IDENTITY)]
)
def test_a_leap_has_no_velocity(track, position, rotation):
    feed(track, [0.0, 0.01])
    track.update(0.02, position, rotation)
    assert track.at(0.03).linear == track.at(0.03).angular == (0.0, 0.0, 0.0)
    assert track.at(0.03).translation == position
    track.update(0.03, np.add(position, 0.001).tolist(), rotation)
    np.testing.assert_allclose(track.at(0.03).linear, 0.1, rtol=1e-9)


def test_a_pose_may_hold_for_ever(track):
    track.hold((1.0, 2.0, 3.0), IDENTITY)
    assert track.fault(1e9) == track.fault(0.0) == ""
    assert track.at(1e9).translation == (1.0, 2.0, 3.0)
