"""Messages as nodes get them."""

import io

import genpy
from rospy.numpy_msg import numpy_msg

from deformable_manipulation.msg import Distances, ObjectState

FRAME = "map"


def transmitted(message):
    """A message as a node with rospy.numpy_msg receives it."""
    buffer = io.BytesIO()
    message.serialize(buffer)
    return numpy_msg(type(message))().deserialize(buffer.getvalue())


def stamped(message, stamp, cycle, reset_count=0):
    """Fill in what every message of a cycle carries; ``stamp`` in s."""
    message.header.frame_id = FRAME
    message.header.stamp = genpy.Time.from_sec(stamp)
    message.cycle = cycle
    message.reset_count = reset_count
    return message


def state_message(stamp=1.0, cycle=0, reset_count=0, **fields):
    return stamped(ObjectState(**fields), stamp, cycle, reset_count)


def distances_message(stamp=1.0, cycle=0, reset_count=0, **fields):
    return stamped(Distances(**fields), stamp, cycle, reset_count)
