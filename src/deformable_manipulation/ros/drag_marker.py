"""An interactive marker that is dragged by hand in RViz."""

import threading

import numpy as np
from geometry_msgs.msg import Point, Pose, Quaternion
from interactive_markers.interactive_marker_server import InteractiveMarkerServer
from std_msgs.msg import ColorRGBA, Header
from visualization_msgs.msg import (
    InteractiveMarker,
    InteractiveMarkerControl,
    InteractiveMarkerFeedback,
    Marker,
)

# One topic namespace for all nodes of a run, so that RViz needs one display.
_TOPICS = "interactive_markers"

_COLOR = ColorRGBA(0.95, 0.6, 0.1, 0.45)
_DIAMETER = 0.11  # m, around the ball that stands for an agent
_ARROW_SCALE = 0.32  # m, from tip to tip
_LEAST_MOVE = 5e-4  # m, that is worth a message
_HALF = np.sqrt(0.5)
# RViz moves along the x axis of a control's orientation.
_AXES = {
    "x": Quaternion(_HALF, 0.0, 0.0, _HALF),
    "y": Quaternion(0.0, 0.0, _HALF, _HALF),
    "z": Quaternion(0.0, _HALF, 0.0, _HALF),
}
_HOLDING = (InteractiveMarkerFeedback.POSE_UPDATE, InteractiveMarkerFeedback.KEEP_ALIVE)


def marker_server():
    """The server of a node's interactive markers, on the run's topics for them."""
    return InteractiveMarkerServer(_TOPICS)


class DragMarker:
    """A handle at something that follows it as it can: an arrow per axis, and a ball.

    The ball moves in the plane of the picture and has the menu, under the right button. While it
    is held the handle stays with the hand; otherwise it goes with what it stands for.

    Args:
        server: of :func:`marker_server`; one for all markers of a node.
        name: of the marker.
        frame: fixed frame; feedback in another one is refused.
        drag: called with a position (3,) [m] while it is held; ValueError: it is refused.
        release: called when it is let go.
        menu: MenuHandler, or None.
        warn: called with a sentence for what is refused.
    """

    def __init__(self, server, name, frame, drag, release, warn, menu=None):
        self._name, self._frame = name, frame
        self._drag, self._release, self._warn = drag, release, warn
        self._lock = threading.Lock()
        self._held = False
        self._shown = None  # (3,) m; None: where the hand has left it
        self._server = server
        self._marker = _marker(name, frame)
        self._menu = menu
        self._is_there = False

    def show(self, position):
        """Put the handle to a position (3,) [m], unless it is held."""
        position = np.array(position, dtype=float)
        with self._lock:
            if self._held or not np.isfinite(position).all():
                return
            if self._shown is not None and abs(position - self._shown).max() < _LEAST_MOVE:
                return
            self._shown = position
            pose = Pose(Point(*position), Quaternion(0.0, 0.0, 0.0, 1.0))
            if self._is_there:
                self._server.setPose(self._name, pose)
            else:
                self._insert(pose)
            self._server.applyChanges()

    def let_go(self):
        """What it stands for is no longer held, whatever the hand does."""
        with self._lock:
            self._held = False

    def _insert(self, pose):
        self._is_there = True
        self._marker.pose = pose
        self._server.insert(self._marker, self._on_feedback)
        if self._menu is not None:
            self._menu.apply(self._server, self._name)

    def _on_feedback(self, feedback):
        if feedback.event_type in _HOLDING:
            self._hold(feedback)
        elif feedback.event_type == InteractiveMarkerFeedback.MOUSE_UP:
            self.let_go()
            self._release()

    def _hold(self, feedback):
        is_new = feedback.event_type == InteractiveMarkerFeedback.POSE_UPDATE
        with self._lock:
            if is_new:
                self._shown = None
            elif not self._held:
                return  # it is held, but not moved yet
        if feedback.header.frame_id != self._frame:
            self._warn(
                f"The marker of {self._name} was moved in frame '{feedback.header.frame_id}'; "
                f"only '{self._frame}' is allowed."
            )
            return
        place = feedback.pose.position
        try:
            self._drag((place.x, place.y, place.z))
        except ValueError as error:
            self._warn(f"The marker of {self._name} is not followed: {error}.")
            return
        with self._lock:
            self._held = True


def _marker(name, frame):
    marker = InteractiveMarker(header=Header(frame_id=frame), name=name)
    marker.scale = _ARROW_SCALE
    for axis, orientation in _AXES.items():
        arrow = InteractiveMarkerControl(name="move_" + axis, orientation=orientation)
        arrow.interaction_mode = InteractiveMarkerControl.MOVE_AXIS
        marker.controls.append(arrow)
    marker.controls.append(_ball())
    return marker


def _ball():
    ball = Marker(type=Marker.SPHERE, color=_COLOR)
    ball.scale.x = ball.scale.y = ball.scale.z = _DIAMETER
    ball.pose.orientation.w = 1.0
    control = InteractiveMarkerControl(name="move", always_visible=True, markers=[ball])
    control.orientation.w = 1.0
    control.orientation_mode = InteractiveMarkerControl.VIEW_FACING
    control.interaction_mode = InteractiveMarkerControl.MOVE_PLANE
    control.description = "drag; right button: menu"
    return control
