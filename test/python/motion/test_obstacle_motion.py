"""Obstacles on paths."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from deformable_manipulation.geometry.rotation import from_vector, multiply, rotate, to_vector
from deformable_manipulation.motion.obstacle_motion import ObstaclePath, obstacle_places
from deformable_manipulation.scenario.spec import PathMotion, PolygonObstacle, PoseWaypoint

SQUARE = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))
OWN = {"translation": (1.0, 2.0, 3.0), "rotation": (0.0, 0.6, 0.0, 0.8)}


def turned(*vector):
    """The rotation about the direction of a vector by its length [rad]."""
    return from_vector(vector)


WAYPOINTS = (
    PoseWaypoint(1.0, (0.0, 0.0, 0.0), turned(0.0, 0.0, 0.0)),
    PoseWaypoint(3.0, (0.1, 0.4, -0.2), turned(0.3, 0.0, 1.0)),
    PoseWaypoint(4.0, (0.3, 0.5, -0.2), turned(0.5, -0.4, 2.0)),
    PoseWaypoint(8.0, (0.2, 0.9, 0.1), turned(0.5, -0.4, 4.5)),
)


def path_of(waypoints):
    return ObstaclePath(PolygonObstacle("p", SQUARE, motion=PathMotion(tuple(waypoints)), **OWN))


def same_rotation(a, b):
    return abs(abs(np.dot(a, b)) - 1.0) < 1e-12


def check_velocity(path, time, step=1e-5):
    """The velocities are the rates of change of the pose, by central differences."""
    before, now, after = (path.at(time + shift) for shift in (-step, 0.0, step))
    linear = np.subtract(after.translation, before.translation) / (2.0 * step)
    np.testing.assert_allclose(now.linear, linear, atol=1e-6)
    for axis in np.eye(3):
        change = np.subtract(rotate(after.rotation, axis), rotate(before.rotation, axis))
        expected = np.cross(now.angular, rotate(now.rotation, axis))
        np.testing.assert_allclose(change / (2.0 * step), expected, atol=1e-6)


def test_it_passes_its_waypoints_relative_to_its_own_pose():
    path = path_of(WAYPOINTS)
    for waypoint in WAYPOINTS:
        pose = path.at(waypoint.time)
        np.testing.assert_allclose(
            pose.translation, np.add(OWN["translation"], waypoint.position), atol=1e-12
        )
        assert same_rotation(pose.rotation, multiply(waypoint.orientation, OWN["rotation"]))


def test_it_rests_before_and_after():
    path = path_of(WAYPOINTS)
    for time, waypoint in ((-5.0, WAYPOINTS[0]), (0.0, WAYPOINTS[0]), (99.0, WAYPOINTS[-1])):
        pose = path.at(time)
        np.testing.assert_allclose((pose.linear, pose.angular), 0.0, atol=1e-12)
        assert same_rotation(pose.rotation, multiply(waypoint.orientation, OWN["rotation"]))


@pytest.mark.parametrize("time", np.linspace(0.9, 8.1, 41))
def test_the_velocity_is_the_rate_of_change_of_the_pose(time):
    check_velocity(path_of(WAYPOINTS), time)


def test_neither_velocity_leaps_at_a_waypoint():
    path = path_of(WAYPOINTS)
    for waypoint in WAYPOINTS:
        before, after = path.at(waypoint.time - 1e-7), path.at(waypoint.time + 1e-7)
        np.testing.assert_allclose(before.linear, after.linear, atol=1e-5)
        np.testing.assert_allclose(before.angular, after.angular, atol=1e-5)
    # It turns on through an inner waypoint where the turns on both sides agree.
    assert path.at(WAYPOINTS[1].time).angular[2] > 0.5


coordinates = st.tuples(*3 * (st.floats(-1.0, 1.0),))


@settings(max_examples=40, deadline=None)
@given(
    st.lists(st.tuples(st.floats(0.2, 5.0), coordinates, coordinates), min_size=1, max_size=4),
    st.floats(0.0, 1.0),
)
def test_any_path_has_the_velocity_of_its_pose(pieces, part):
    times = np.cumsum([piece[0] for piece in pieces]).tolist()
    path = path_of(
        PoseWaypoint(time, position, turned(*rotation))
        for time, (_, position, rotation) in zip(times, pieces)
    )
    time = times[0] + part * (times[-1] - times[0])
    if all(abs(time - each) > 1e-4 for each in times):
        check_velocity(path, time)


def test_it_stands_at_a_single_waypoint():
    path = path_of(WAYPOINTS[1:2])
    assert path.at(0.0) == path.at(7.0)
    assert path.at(7.0).linear == path.at(7.0).angular == (0.0, 0.0, 0.0)


@given(coordinates)
def test_rotation_vectors_are_those_of_their_rotations(vector):
    np.testing.assert_allclose(to_vector(from_vector(vector)), vector, atol=1e-9)


def test_places_are_along_the_path():
    obstacle = PolygonObstacle("p", SQUARE, motion=PathMotion(WAYPOINTS), **OWN)
    places = obstacle_places(obstacle, 8)
    assert [place.points for place in places] == 8 * [SQUARE]
    np.testing.assert_allclose(places[-1].translation, (1.2, 2.9, 3.1))
    still = PolygonObstacle("p", SQUARE, **OWN)
    assert obstacle_places(still, 8) == [still]
