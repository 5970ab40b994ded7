"""Somebody who publishes the points of a floor as a camera sees them, and may spoil them."""

import numpy as np
import rospy
from geometry_msgs.msg import Quaternion, Transform, TransformStamped, Vector3
from sensor_msgs.msg import PointCloud2
from std_msgs.msg import Header
from tf2_msgs.msg import TFMessage

from deformable_manipulation.ros import node
from deformable_manipulation.ros.point_clouds import to_point_cloud

PERIOD = 0.05  # s
HEIGHT = 0.1  # m, of the floor
SPACING = 0.05  # m, of its points
_CAMERA = (0.0, 0.0, 3.0)  # m; it looks down: turned about the x axis by half a turn
_FRAME = "looking_down"


class SeenFloor:
    """Publishes the floor's points in the camera's frame.

    Attributes:
        spoil: function of a PointCloud2, gives the one that is published, or None.
    """

    def __init__(self, topic):
        self.spoil = intact
        line = np.arange(-1.5, 3.0, SPACING)
        x, y = np.meshgrid(line, line)
        self._points = np.stack((x, -y, np.full_like(x, _CAMERA[2] - HEIGHT)), axis=-1)
        self._publisher = rospy.Publisher(topic, PointCloud2, queue_size=1)
        self._frames = rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True)
        place = Transform(Vector3(*_CAMERA), Quaternion(1.0, 0.0, 0.0, 0.0))
        self._frames.publish(TFMessage([TransformStamped(Header(frame_id="map"), _FRAME, place)]))
        node.every(PERIOD, self._publish)

    def _publish(self):
        cloud = to_point_cloud(self._points, rospy.Time.now().to_sec(), _FRAME)
        cloud = self.spoil(cloud)
        if cloud is not None:
            self._publisher.publish(cloud)


def intact(cloud):
    return cloud


def lost(_cloud):
    return None


def late(cloud):
    cloud.header.stamp -= rospy.Duration(1.0)
    return cloud


def without_stamp(cloud):
    cloud.header.stamp = rospy.Time()
    return cloud


def of_no_numbers(cloud):
    cloud.data = np.full(len(cloud.data) // 4, np.nan, dtype="<f4").tobytes()
    return cloud


def empty(cloud):
    cloud.width, cloud.row_step, cloud.data = 0, 0, b""
    return cloud


def cut_off(cloud):
    cloud.data = cloud.data[:-100]
    return cloud


def in_unknown_frame(cloud):
    cloud.header.frame_id = "nowhere"
    return cloud
