"""What a node draws for RViz."""

import threading
import time

import rospy
from visualization_msgs.msg import MarkerArray

from deformable_manipulation.ros import node

_PERIOD = 0.04  # s, at least between two pictures
_BACKGROUND_PERIOD = 2.0  # s
_REDRAW_PERIOD = 0.5  # s


class MarkerPublisher:
    """Draws a node's newest state on the topic ``markers`` while somebody subscribes.

    At most 25 times per second. While nothing new comes it draws again, so that viewers that come
    late, or missed the last state, see it, too.

    Args:
        draw: makes a MarkerArray of what ``show`` got.
        background: makes a MarkerArray of what hardly changes; drawn every 2 s, and again with
            every redraw; default: there is none.
    """

    def __init__(self, draw, background=None):
        self._draw = draw
        self._background = background
        self._lock = threading.Lock()
        self._newest = None
        self._last = self._last_background = 0.0
        self._publisher = rospy.Publisher("markers", MarkerArray, queue_size=4)
        node.every(_REDRAW_PERIOD, self._redraw)

    def show(self, *newest):
        """Draw this, now or later, unless something newer comes before."""
        with self._lock:
            self._newest = newest
            now = time.monotonic()
            if self._is_watched() and now - self._last >= _PERIOD:
                self._publish(now, now - self._last_background >= _BACKGROUND_PERIOD)

    def _redraw(self):
        with self._lock:
            now = time.monotonic()
            if self._is_watched() and self._newest is not None and self._is_quiet(now):
                self._publish(now, True)

    def _is_watched(self):
        return self._publisher.get_num_connections() > 0

    def _is_quiet(self, now):
        # The timer is not exact.
        return now - self._last >= 0.5 * _REDRAW_PERIOD

    def _publish(self, now, with_background):
        self._last = now
        if with_background and self._background is not None:
            self._last_background = now
            self._publisher.publish(self._background())
        self._publisher.publish(self._draw(*self._newest))
