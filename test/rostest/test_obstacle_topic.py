#!/usr/bin/env python3
"""An obstacle whose poses come from a topic, as from a tracker, or dragged by hand."""

import tracked_obstacle
from observed_run import run_tests
from walking_pose import WalkingPose, in_another_frame, late, not_finite, without_orientation

LOST = "obstacle 'ground' is lost: no pose for"


class ObstacleTopicTest(tracked_obstacle.TrackedObstacleTest):
    origin = "on /moved_ground"

    @classmethod
    def start_obstacle(cls):
        return WalkingPose("moved_ground", tracked_obstacle.START, tracked_obstacle.VELOCITY)

    def test_late(self):
        self.assert_stops_and_goes_on(late, LOST, log=(": its stamp is 1.0 s old",))

    def test_not_finite(self):
        self.assert_stops_and_goes_on(not_finite, LOST, log=(": it is not finite",))

    def test_in_another_frame(self):
        self.assert_stops_and_goes_on(in_another_frame, LOST, log=("in frame 'tool0', not in",))

    def test_without_orientation(self):
        self.assert_stops_and_goes_on(without_orientation, LOST, log=("has the norm 0, not 1",))


if __name__ == "__main__":
    run_tests("obstacle_topic")
