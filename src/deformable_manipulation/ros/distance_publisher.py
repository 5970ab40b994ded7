"""The distances between the object, with all its copies, and the obstacles under ROS."""

import time

import rospy
from rospy.numpy_msg import numpy_msg

from deformable_manipulation.closed_loop import make_minimum_distance
from deformable_manipulation.msg import Distances
from deformable_manipulation.ros import node
from deformable_manipulation.ros.conversions import MessageError, fill_distances, points_of
from deformable_manipulation.ros.marker_publisher import MarkerPublisher
from deformable_manipulation.ros.obstacle_markers import distance_markers, obstacle_markers


class DistancePublisher:
    """Computes distances of states, publishes and draws them; which node it is in does not matter.

    Leaves the process with a message if the obstacles cannot be used.

    Args:
        scenario: the checked scenario.
    """

    def __init__(self, scenario):
        try:
            self._distance = make_minimum_distance(scenario)
            obstacles = obstacle_markers(scenario.obstacles, scenario.frame)
        except ValueError as error:  # a file has gone or changed since the scenario was checked
            node.refuse(f"The obstacles cannot be used: {error}")
        for warning in self._distance.warnings:
            rospy.logwarn(warning)
        self._latch = rospy.get_param("~lockstep", False)
        self._publisher = rospy.Publisher(
            "distances", numpy_msg(Distances), queue_size=node.QUEUE_SIZE, latch=self._latch
        )
        self._markers = MarkerPublisher(distance_markers, lambda: obstacles)
        node.await_subscribers(self._publisher)

    def compute(self, state):
        """The core's Distances of an ObjectState, and the time [s] that they took.

        Raises MessageError: its points cannot be used.
        """
        started = time.perf_counter()
        try:
            distances = self._distance.compute(points_of(state))
        except MessageError:
            raise
        except ValueError as error:
            raise MessageError(f"points: {error}") from error
        return distances, time.perf_counter() - started

    def publish(self, state, distances, computation_time):
        """Publish and draw what :meth:`compute` gave for a state."""
        if self._latch or self._publisher.get_num_connections():
            message = fill_distances(Distances(), state, distances, computation_time)
            self._publisher.publish(message)
        self._markers.show(distances, state.header)
