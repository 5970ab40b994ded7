"""Whether everything that shows a state has been drawn."""

import threading

import rospy
from visualization_msgs.msg import Marker, MarkerArray

from deformable_manipulation.ros.obstacle_markers import DISTANCE_LABELS


class MarkerWatch:
    """Notices when every node has drawn a state since it was asked about it.

    Args:
        stamp: of the state.
        times: how often; 2: also what is drawn now and then is there.
    """

    topic = "/markers"

    def __init__(self, stamp, times=2):
        self._times = times
        self._lock = threading.Lock()
        self._drawn = {}  # stamp of the newest marker of each node
        self._distance = ""
        self.expect(stamp)
        self._subscriber = rospy.Subscriber(self.topic, MarkerArray, self._count, queue_size=100)

    def expect(self, stamp):
        """Watch for another state from now on."""
        with self._lock:
            self._stamp = stamp
            self._redraws = {}
            self._distance = ""

    @property
    def distance(self):
        """The label of the state's distance to the obstacles; empty: none has been drawn."""
        with self._lock:
            return self._distance

    def missing(self, publishers):
        """Those of these nodes that have not drawn the state yet, everything that they draw."""
        with self._lock:
            return [node for node in publishers if self._redraws.get(node, 0) < self._times]

    def describe(self, nodes):
        """What these nodes have drawn instead, for a message."""
        with self._lock:
            return ", ".join(
                f"{node} drew {self._state_text(self._drawn.get(node))}" for node in nodes
            )

    def _state_text(self, stamp):
        if stamp is None:
            return "nothing"
        if stamp == self._stamp:
            return "the state, but not again"
        return f"another state, {(stamp - self._stamp).to_sec():+.3f} s away"

    def close(self):
        """Stop watching."""
        self._subscriber.unregister()

    def _count(self, array):
        node = array._connection_header["callerid"]
        stamps = {marker.header.stamp for marker in array.markers}
        with self._lock:
            self._drawn[node] = max(stamps, default=None)
            if self._stamp in stamps:
                self._redraws[node] = self._redraws.get(node, 0) + 1
                for marker in array.markers:
                    if marker.ns == DISTANCE_LABELS and marker.action == Marker.ADD:
                        self._distance = marker.text
