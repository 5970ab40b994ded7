"""Where an assistant is to be, for RViz."""

import numpy as np
from geometry_msgs.msg import Point
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

_COLOR = ColorRGBA(0.35, 0.35, 0.35, 0.6)
_SHAFT, _HEAD, _HEAD_LENGTH = 0.008, 0.03, 0.06  # m


def target_markers(header, agent, leader, target):
    """An arrow from the leader's held point (3,) [m] to an assistant's target; nan: none."""
    arrow = Marker(header=header, ns=f"target_{agent}", id=0, type=Marker.ARROW, color=_COLOR)
    arrow.action = Marker.ADD if np.isfinite(target).all() else Marker.DELETE
    arrow.pose.orientation.w = 1.0
    arrow.scale.x, arrow.scale.y, arrow.scale.z = _SHAFT, _HEAD, _HEAD_LENGTH
    if arrow.action == Marker.ADD:
        arrow.points = [Point(*leader), Point(*target)]
    return MarkerArray([arrow])
