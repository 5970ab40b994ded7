"""Somebody who publishes the poses of something that moves, and may spoil them."""

import numpy as np
import rospy
from geometry_msgs.msg import Point, PoseStamped, Quaternion

from deformable_manipulation.ros import node

PERIOD = 0.01  # s
NAN = float("nan")


class WalkingPose:
    """Publishes poses of constant velocity as time goes by.

    Attributes:
        spoil: function of a PoseStamped, gives the one that is published, or None.
    """

    def __init__(self, topic, start, velocity, orientation=(0.0, 0.0, 0.0, 1.0)):
        self.spoil = intact
        self._start, self._velocity = np.array(start), np.array(velocity)
        self._orientation = orientation
        self._began = rospy.Time.now()
        self._publisher = self._advertise(topic)
        node.every(PERIOD, self._publish)

    def position(self, stamp):
        """Where it is at a time."""
        return self._start + (stamp - self._began).to_sec() * self._velocity

    def _advertise(self, topic):
        return rospy.Publisher(topic, PoseStamped, queue_size=1)

    def _publish(self):
        pose = PoseStamped()
        pose.header.stamp = rospy.Time.now()
        pose.header.frame_id = "map"
        pose.pose.position = Point(*self.position(pose.header.stamp))
        pose.pose.orientation = Quaternion(*self._orientation)
        pose = self.spoil(pose)
        if pose is not None:
            self._send(pose)

    def _send(self, pose):
        self._publisher.publish(pose)


def intact(pose):
    return pose


def lost(_pose):
    return None


def late(pose):
    pose.header.stamp -= rospy.Duration(1.0)
    return pose


def not_finite(pose):
    pose.pose.position.y = NAN
    return pose


def in_another_frame(pose):
    pose.header.frame_id = "tool0"
    return pose


def without_orientation(pose):
    pose.pose.orientation = Quaternion()
    return pose
