#!/usr/bin/env python3
"""An obstacle that is where a tf frame is."""

import rospy
import tracked_obstacle
from geometry_msgs.msg import Transform, TransformStamped, Vector3
from observed_run import run_tests
from tf2_msgs.msg import TFMessage
from walking_pose import WalkingPose


class WalkingFrame(WalkingPose):
    """Sends its poses as transforms."""

    def _advertise(self, topic):
        self._child = topic
        return rospy.Publisher("/tf", TFMessage, queue_size=10)

    def _send(self, pose):
        position = pose.pose.position
        place = Transform(Vector3(position.x, position.y, position.z), pose.pose.orientation)
        self._publisher.publish(TFMessage([TransformStamped(pose.header, self._child, place)]))


class ObstacleFrameTest(tracked_obstacle.TrackedObstacleTest):
    origin = "of tf frame 'moved_ground' in 'map'"

    @classmethod
    def start_obstacle(cls):
        return WalkingFrame("moved_ground", tracked_obstacle.START, tracked_obstacle.VELOCITY)


if __name__ == "__main__":
    run_tests("obstacle_frame")
