#!/usr/bin/env python3
"""An obstacle is dragged by its interactive marker: slowly."""

import unittest

import numpy as np
from marker_hand import MarkerHand
from observed_run import Messages, call, observe_states, read_scenario, run_tests
from rospy.numpy_msg import numpy_msg
from std_srvs.srv import Trigger

from deformable_manipulation.msg import Distances

TOLERANCE = 1e-3  # m: the poses are moved on to the time of the state
ROUNDING = 1e-6  # m/s


class DragObstacleTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scenario = read_scenario()
        cls.hand = MarkerHand("ground")
        cls.distances = Messages("distances", numpy_msg(Distances))
        cls.states = observe_states(cls.hand.on_state)

    def tearDown(self):
        self.hand.act = None

    def wait_for_place(self, place):
        """Wait until it is at a place, relative to the scenario's; the messages by then."""
        expected = np.array(self.scenario.obstacles[0].translation) + place

        def is_there(distances):
            poses = distances.obstacle_poses
            return not distances.fault and np.abs(poses[:3] - expected).max() < TOLERANCE

        self.distances.wait_for(is_there, "the obstacle at {}".format(place), len(self.distances))
        return len(self.distances)

    def test_it_follows_the_hand_and_comes_back_with_a_reset(self):
        self.wait_for_place((0.0, 0.0, 0.0))
        start = len(self.distances)
        self.hand.drag((0.05, 0.0, -0.15))
        end = self.wait_for_place((0.05, 0.0, -0.15))
        self.hand.release((0.05, 0.0, -0.15))
        moved = [each for each in self.distances[start:end] if not each.fault]
        speeds = [np.abs(each.obstacle_velocities).max(initial=0.0) for each in moved]
        limit = self.scenario.leader.max_velocity
        self.assertGreater(max(speeds), 0.9 * limit)
        self.assertLessEqual(max(speeds), limit * (1.0 + ROUNDING))
        self.assertTrue(call("reset", Trigger).success)
        self.wait_for_place((0.0, 0.0, 0.0))

    def test_let_go_it_stops(self):
        self.assertTrue(call("reset", Trigger).success)
        self.wait_for_place((0.0, 0.0, 0.0))
        self.hand.drag((0.0, 0.0, -0.5))
        self.distances.wait_for(
            lambda each: np.abs(each.obstacle_velocities).max(initial=0.0) > 0.05,
            "motion",
            len(self.distances),
        )
        self.hand.release((0.0, 0.0, -0.5))
        self.distances.wait_for(
            lambda each: not each.fault and not each.obstacle_velocities.any(),
            "rest",
            len(self.distances),
        )
        self.assertGreater(self.distances[-1].obstacle_poses[2], -0.4)


if __name__ == "__main__":
    run_tests("drag_obstacle")
