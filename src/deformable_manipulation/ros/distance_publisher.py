"""The distances between the object, with all its copies, and the obstacles under ROS."""

import time
from dataclasses import dataclass

import numpy as np
import rospy
from rospy.numpy_msg import numpy_msg

from deformable_manipulation.closed_loop import make_minimum_distance
from deformable_manipulation.distance.features import Distances as Features
from deformable_manipulation.msg import Distances
from deformable_manipulation.ros import node
from deformable_manipulation.ros.conversions import MessageError, fill_distances, points_of
from deformable_manipulation.ros.diagnostics import cycle_monitor, publish_diagnostics
from deformable_manipulation.ros.health import input_report
from deformable_manipulation.ros.marker_publisher import MarkerPublisher
from deformable_manipulation.ros.obstacle_frames import ObstacleFrames
from deformable_manipulation.ros.obstacle_markers import distance_markers, obstacle_markers
from deformable_manipulation.ros.obstacle_tracker import ObstacleTracker
from deformable_manipulation.ros.overrun_report import age_of


@dataclass(frozen=True)
class Measured:
    """The distances of one state."""

    distances: Features
    poses: np.ndarray  # (K, 7) of the moving obstacles
    fault: str  # a clause that says why the distances are not known; empty: they are
    computation_time: float  # s

    def usable(self):
        """The distances. Raises MessageError: they are not known."""
        if self.fault:
            raise MessageError(self.fault)
        return self.distances


class DistancePublisher:
    """Measures distances of states, publishes and draws them; which node it is in does not matter.

    Reads the node's parameters ``~lockstep`` and ``~tf_prefix``. Leaves the process with a message
    if the obstacles cannot be used.

    Args:
        scenario: the checked scenario.
    """

    def __init__(self, scenario):
        tf_prefix = rospy.get_param("~tf_prefix", "")
        try:
            self._distance = make_minimum_distance(scenario)
            markers = obstacle_markers(scenario.obstacles, scenario.frame, tf_prefix=tf_prefix)
        except ValueError as error:  # a file has gone or changed since the scenario was checked
            node.refuse(f"The obstacles cannot be used: {error}")
        for warning in self._distance.warnings:
            rospy.logwarn(warning)
        self._obstacles = ObstacleTracker(scenario)
        self._frames = ObstacleFrames(scenario, tf_prefix)
        self._latch = rospy.get_param("~lockstep", False)
        self._publisher = rospy.Publisher(
            "distances", numpy_msg(Distances), queue_size=node.QUEUE_SIZE, latch=self._latch
        )
        self._markers = MarkerPublisher(self._draw, lambda: markers)
        self._cycles = cycle_monitor(scenario)
        self._fault = ""  # of the newest state
        publish_diagnostics(
            {"distances": self._cycles.report, "obstacles": lambda: input_report(self._fault)}
        )
        node.await_subscribers(self._publisher)

    def measure(self, state):
        """The Measured distances of an ObjectState. Raises MessageError: it cannot be used."""
        try:
            return self._measure(state)
        except MessageError as error:
            self._cycles.failed(f"State {state.cycle} cannot be used: {error}.")
            raise

    def _measure(self, state):
        started = time.perf_counter()
        points = points_of(state)
        try:
            self._fault = fault = self._obstacles.move(self._distance, state)
            if fault:
                distances = Features.unknown(len(points), self._distance.names)
            else:
                distances = self._distance.compute(points)
        except ValueError as error:
            raise MessageError(f"points: {error}") from error
        elapsed = time.perf_counter() - started
        self._cycles.answered(elapsed, age_of(state))
        return Measured(distances, self._obstacles.poses(), fault, elapsed)

    def publish(self, state, measured):
        """Publish and draw what :meth:`measure` gave for a state."""
        if self._latch or self._publisher.get_num_connections():
            self._publisher.publish(
                fill_distances(
                    Distances(),
                    state,
                    measured.distances,
                    measured.computation_time,
                    self._obstacles.names,
                    measured.poses,
                    measured.fault,
                )
            )
        self._markers.show(measured.distances, state.header, measured.poses)

    def _draw(self, distances, header, poses):
        self._frames.send(header, poses)
        return distance_markers(distances, header)
