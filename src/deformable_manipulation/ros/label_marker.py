"""The times of snapshots, written where the leader was."""

import numpy as np
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker

NAMESPACE = "time_labels"
_COLOR = ColorRGBA(0.1, 0.1, 0.1, 1.0)
_HEIGHT, _ABOVE = 0.12, 0.15  # m, of the letters; from the leader's held point
_NEAR = 0.3  # m, where the leader was nearer together one label tells all times


def label_markers(header, labels):
    """Texts above places of the leader.

    Args:
        labels: (place (3,) [m], text) of each. Without any a marker that draws nothing.
    """
    nothing = Marker(header=header, ns=NAMESPACE, id=0, action=Marker.DELETE)
    texts = [_text(header, number, *label) for number, label in enumerate(labels, start=1)]
    return [nothing, *texts]


def time_labels(times, places):
    """Labels of times [s] at which the leader was at places (3,) [m]; near ones have one."""
    groups = []  # of (place of the first, times)
    for time, place in zip(times, places):
        near = [each for each in groups if np.linalg.norm(each[0] - place) < _NEAR]
        if near:
            near[0][1].append(time)
        else:
            groups.append((place, [time]))
    return [(place, ", ".join(f"{time:g}" for time in near) + " s") for place, near in groups]


def _text(header, number, place, text):
    label = Marker(header=header, ns=NAMESPACE, id=number, type=Marker.TEXT_VIEW_FACING)
    label.color = _COLOR
    label.pose.orientation.w = 1.0
    label.pose.position.x, label.pose.position.y, label.pose.position.z = place
    label.pose.position.z += _ABOVE
    label.scale.z = _HEIGHT
    label.text = text
    return label
