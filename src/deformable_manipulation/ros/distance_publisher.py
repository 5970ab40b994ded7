"""The distances between the object, with all its copies, and the obstacles under ROS."""

import time
from typing import NamedTuple

import numpy as np
import rospy
from rospy.numpy_msg import numpy_msg

from deformable_manipulation.cycles.health import input_report
from deformable_manipulation.distance.factory import make_known_distance
from deformable_manipulation.distance.features import Distances as DistanceFeatures
from deformable_manipulation.msg import Distances
from deformable_manipulation.ros import node
from deformable_manipulation.ros.conversions import (
    MessageError,
    agent_orientations,
    agent_positions,
    fill_distances,
    points_of,
)
from deformable_manipulation.ros.diagnostics import cycle_monitor, publish_diagnostics
from deformable_manipulation.ros.live_obstacles import LiveObstacles
from deformable_manipulation.ros.marker_publisher import MarkerPublisher
from deformable_manipulation.ros.obstacle_frames import ObstacleFrames
from deformable_manipulation.ros.obstacle_markers import distance_markers, obstacle_markers
from deformable_manipulation.ros.obstacle_tracker import ObstacleTracker
from deformable_manipulation.ros.overrun_report import age_of


class Computed(NamedTuple):
    """The distances of a state."""

    distances: DistanceFeatures  # of the core
    poses: np.ndarray  # (K, 7) of the moving obstacles
    computation_time: float  # s
    fault: str  # why they are not known, as a clause; empty if they are
    seen: dict  # what is known of live obstacles, by their indices


def known_distances(computed):
    """What :meth:`.StateAnswers.answer` needs of what was computed.

    Raises:
        MessageError: they are not known.
    """
    if computed.fault:
        raise MessageError(computed.fault)
    return computed.distances, computed.poses, computed.seen


class DistancePublisher:
    """Computes distances of states, publishes and draws them; which node it is in does not matter.

    Reads the node's parameters ``~lockstep`` and ``~tf_prefix``. Leaves the process with a message
    if the obstacles cannot be used.

    Args:
        scenario: the checked scenario.
    """

    def __init__(self, scenario):
        prefix = rospy.get_param("~tf_prefix", "")
        try:
            self._distance = make_known_distance(scenario)
            obstacles = obstacle_markers(scenario.obstacles, scenario.frame, tf_prefix=prefix)
        except ValueError as error:  # a file has gone or changed since the scenario was checked
            node.refuse(f"The obstacles cannot be used: {error}")
        for warning in self._distance.warnings:
            rospy.logwarn(warning)
        self._scenario = scenario
        self._obstacles = ObstacleTracker(scenario)
        self._live = LiveObstacles(scenario, self._distance)
        self._frames = ObstacleFrames(scenario, prefix)
        self._latch = rospy.get_param("~lockstep", False)
        self._publisher = rospy.Publisher(
            "distances", numpy_msg(Distances), queue_size=node.QUEUE_SIZE, latch=self._latch
        )
        self._markers = MarkerPublisher(self._draw, lambda: obstacles)
        self._cycles = cycle_monitor(scenario)
        self._fault = ""  # of the newest state
        publish_diagnostics(
            {"distances": self._cycles.report, "obstacles": lambda: input_report(self._fault)}
        )
        node.await_subscribers(self._publisher)

    def compute(self, state):
        """What is known about the distances of an ObjectState.

        Raises:
            MessageError: its points cannot be used.
        """
        try:
            return self._compute(state)
        except MessageError as error:
            self._cycles.failed(f"State {state.cycle} cannot be used: {error}.")
            raise

    def _compute(self, state):
        started = time.perf_counter()
        points = points_of(state)
        carried = agent_positions(state, self._scenario), agent_orientations(state, self._scenario)
        faults = (
            self._obstacles.move(self._distance, state),
            self._live.move(state, points, carried),
        )
        self._fault = fault = ", ".join(filter(None, faults))
        try:
            if fault:
                distances = DistanceFeatures.unknown(len(points), self._distance.names)
            else:
                distances = self._distance.compute(points)
        except ValueError as error:
            raise MessageError(f"points: {error}") from error
        elapsed = time.perf_counter() - started
        self._cycles.answered(elapsed, age_of(state))
        return Computed(distances, self._obstacles.poses(), elapsed, fault, self._live.seen())

    def publish(self, state, computed):
        """Publish and draw what :meth:`compute` gave for a state."""
        if self._latch or self._publisher.get_num_connections():
            distances, poses, elapsed, fault, _ = computed
            self._publisher.publish(
                fill_distances(
                    Distances(), state, distances, elapsed, self._obstacles.names, poses, fault
                )
            )
        self._markers.show(computed.distances, state.header, computed.poses)

    def _draw(self, distances, header, poses):
        self._frames.send(header, poses)
        return distance_markers(distances, header, self._scenario)
