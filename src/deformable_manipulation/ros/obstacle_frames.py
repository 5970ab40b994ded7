"""Moving obstacles as tf frames."""

import rospy
from geometry_msgs.msg import Quaternion, Transform, TransformStamped, Vector3
from tf2_msgs.msg import TFMessage

from deformable_manipulation.motion.obstacle_motion import moving_obstacles
from deformable_manipulation.ros.obstacle_markers import obstacle_frame


class ObstacleFrames:
    """Sends the frames that the markers of moving obstacles are drawn in.

    Args:
        scenario: the checked scenario.
        tf_prefix: put before the frames' names.
    """

    def __init__(self, scenario, tf_prefix):
        self._names = [
            obstacle_frame(scenario.obstacles[index], tf_prefix)
            for index in moving_obstacles(scenario)
        ]
        self._sent = None
        if self._names:
            self._publisher = rospy.Publisher("/tf", TFMessage, queue_size=10)

    def send(self, header, poses):
        """Send poses (K, 7) of a state with this header."""
        # Whoever has a transform already complains when it comes again.
        if not self._names or self._sent == (header.stamp, self._publisher.get_num_connections()):
            return
        self._sent = header.stamp, self._publisher.get_num_connections()
        self._publisher.publish(
            TFMessage(
                [
                    TransformStamped(
                        header, name, Transform(Vector3(*pose[:3]), Quaternion(*pose[3:]))
                    )
                    for name, pose in zip(self._names, poses.tolist())
                ]
            )
        )
