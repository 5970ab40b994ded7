"""Poses of tf frames in the fixed frame."""

import threading
import time

import rospy

_POLLING_PERIOD = 0.005  # s of real time: in lock-step the ROS clock may stand still
_PATIENCE = 5.0  # s of real time, between warnings
_IDENTITY = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0)


class Transforms:
    """Looks up frames by tf2, which is loaded and listened to at the first need.

    Args:
        frame: the fixed frame.
    """

    def __init__(self, frame):
        self._frame = frame
        self._lock = threading.Lock()
        self._buffer = None

    def find(self, frame, stamp):
        """The pose of a frame at a time [s], or None if tf does not know it."""
        import tf2_ros

        try:
            return self._look_up(frame, rospy.Time.from_sec(stamp))
        except tf2_ros.TransformException:
            return None

    def await_pose(self, header, timeout):
        """The pose of a message's frame at its stamp, as soon as tf knows it.

        Raises:
            ValueError: tf does not know it, even when the message is older than the timeout [s]; a
                clause that says what tf says.
        """
        if header.frame_id == self._frame:
            return _IDENTITY
        import tf2_ros

        warn_at = time.monotonic() + _PATIENCE
        while True:
            try:
                return self._look_up(header.frame_id, header.stamp)
            except tf2_ros.TransformException as error:
                what = f"frame '{header.frame_id}' cannot be turned into '{self._frame}' at the "
                what += f"stamp: {error}"
            if (rospy.Time.now() - header.stamp).to_sec() > timeout or rospy.is_shutdown():
                raise ValueError(what)
            if time.monotonic() > warn_at:
                rospy.logwarn_throttle(_PATIENCE, f"Still waiting: {what}")
            time.sleep(_POLLING_PERIOD)

    def _look_up(self, frame, stamp):
        found = self._listening().lookup_transform(self._frame, frame, stamp).transform
        place, turn = found.translation, found.rotation
        return (place.x, place.y, place.z), (turn.x, turn.y, turn.z, turn.w)

    def _listening(self):
        with self._lock:
            if self._buffer is None:
                self._buffer = listening_buffer()
        return self._buffer


def listening_buffer():
    """A tf2 buffer of all transforms that come."""
    import tf2_ros  # late: it takes time to load, and few scenarios need it

    buffer = tf2_ros.Buffer(debug=False)
    buffer.listener = tf2_ros.TransformListener(buffer)  # it listens as long as it lives
    return buffer
