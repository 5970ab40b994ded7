#!/usr/bin/env python3
"""A leader that is driven by its pose: a real one, which is followed, lost and found again.

The test publishes the pose.
"""

import numpy as np
import rospy
from faulty_run import FaultTest
from observed_run import run_tests
from walking_pose import (
    WalkingPose,
    in_another_frame,
    intact,
    late,
    lost,
    not_finite,
    without_orientation,
)

from deformable_manipulation.ros.conversions import agent_positions

SPEED = 0.05  # m/s
CLOSE = 0.005  # m: a few cycles of that speed
ALONG_Y = (0.0, 0.0, np.sqrt(0.5), np.sqrt(0.5))


class FaultPoseTest(FaultTest):
    @classmethod
    def setUpClass(cls):
        cls.leader = WalkingPose("leader/pose", [0.0, 0.0, 1.35], [SPEED, 0.0, 0.0], ALONG_Y)
        super().setUpClass()

    def tearDown(self):
        self.leader.spoil = intact

    def test_the_pose_is_followed(self):
        # The first states after a reset may come while the simulated leader has 5 cm to catch up.
        for state in self.states.wait_for_more(55)[5:]:
            position = agent_positions(state, self.scenario)[self.scenario.leader_index]
            expected = self.leader.position(state.header.stamp)
            np.testing.assert_allclose(position, expected, 0.0, CLOSE)

    def assert_stops_and_goes_on(self, spoil, *words):
        with self.subTest(words=words):
            since = rospy.Time.now()
            self.leader.spoil = spoil
            self.assert_waits("no state for")
            self.assertLess(
                (self.states[-1].header.stamp - since).to_sec(), self.patience(), "states go on"
            )
            self.assert_says(*words)
            self.leader.spoil = intact
            self.assert_follows()

    def test_lost(self):
        self.assert_stops_and_goes_on(
            lost, "leader is lost: no pose on /leader/pose newer than 0.2 s"
        )

    def test_late(self):
        self.assert_stops_and_goes_on(late, "leader ignores a pose: its stamp", "not newer")

    def test_not_finite(self):
        self.assert_stops_and_goes_on(not_finite, "it is not finite")

    def test_in_another_frame(self):
        self.assert_stops_and_goes_on(in_another_frame, "it is in frame 'tool0', not in 'map'")

    def test_without_orientation(self):
        self.assert_stops_and_goes_on(without_orientation, "its quaternion has the norm 0, not 1")


if __name__ == "__main__":
    run_tests("fault_pose")
