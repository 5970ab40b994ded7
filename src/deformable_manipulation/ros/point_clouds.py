"""Points as messages."""

import numpy as np
import rospy
from sensor_msgs.msg import PointCloud2, PointField
from std_msgs.msg import Header

_FIELDS = [
    PointField(name=axis, offset=4 * place, datatype=PointField.FLOAT32, count=1)
    for place, axis in enumerate("xyz")
]


def to_point_cloud(points, stamp, frame):
    """Points (..., 3) [m] as PointCloud2, in single precision; an image (H, W, 3) keeps its rows.

    Args:
        points: nan: there is none.
        stamp: [s].
        frame: that they are in.
    """
    data = np.ascontiguousarray(points, dtype="<f4")
    height, width = data.shape[:2] if data.ndim == 3 else (1, len(data))
    return PointCloud2(
        header=Header(stamp=rospy.Time.from_sec(stamp), frame_id=frame),
        height=height,
        width=width,
        fields=_FIELDS,
        is_bigendian=False,
        point_step=12,
        row_step=12 * width,
        data=data.tobytes(),
        is_dense=False,
    )
