"""A hand that drags an interactive marker, as RViz tells of it."""

import rospy
from observed_run import poll
from visualization_msgs.msg import InteractiveMarkerFeedback


class MarkerHand:
    """Drags the marker of a name; ``on_state`` is to be called with every state.

    Attributes:
        act: what is repeated with every state, as RViz does while a marker is held; None: nothing.
    """

    def __init__(self, marker):
        self._marker = marker
        self.act = None
        self._feedback = rospy.Publisher(
            "interactive_markers/feedback", InteractiveMarkerFeedback, queue_size=100
        )
        poll(self._feedback.get_num_connections, "the marker's server")

    def on_state(self, _state):
        act = self.act
        if act is not None:
            act()

    def drag(self, position, frame="map"):
        """Hold the marker at a place from now on."""
        self.act = lambda: self.send(InteractiveMarkerFeedback.POSE_UPDATE, position, frame)

    def release(self, position):
        """Let the marker go at a place."""
        self.act = None
        self.send(InteractiveMarkerFeedback.MOUSE_UP, position)

    def select(self, entry):
        """Choose an entry of the menu by its number."""
        self.send(InteractiveMarkerFeedback.MENU_SELECT, entry=entry)

    def send(self, kind, position=(0.0, 0.0, 0.0), frame="map", entry=0):
        message = InteractiveMarkerFeedback(
            event_type=kind, marker_name=self._marker, client_id="hand", menu_entry_id=entry
        )
        message.header.frame_id = frame
        place = message.pose.position
        place.x, place.y, place.z = position
        message.pose.orientation.w = 1.0
        self._feedback.publish(message)
