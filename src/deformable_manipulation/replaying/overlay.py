"""A bag in which RViz shows a replayed object over the measured one."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import yaml
from rosbags.rosbag1 import Writer
from rosbags.typesys import Stores, get_typestore

from deformable_manipulation.authoring.rviz_configuration import configuration_around
from deformable_manipulation.replaying.measured_shapes import MeasuredShapes

_FRAME = "map"
_TOPIC = "/markers"  # where the package's RViz configurations look
_RATE = 30.0  # Hz, at most
_BALL, _LINE = 0.014, 0.003  # m
_MEASURED, _PREDICTED = (0.85, 0.37, 0.0), (0.0, 0.45, 0.7)
_LINES, _BALLS = 5, 7  # types of visualization_msgs/Marker
_ROOM = 0.1  # m, around all points


@dataclass(frozen=True)
class Overlay:
    """What was measured, and what was simulated.

    Attributes:
        shapes: the measured points.
        predicted: (T, M, 3) m, the same points as simulated.
        whole: (T, P, 3) m, all points of the simulated object.
        edges: (E, 2) pairs of points that are drawn as lines.
    """

    shapes: MeasuredShapes
    predicted: np.ndarray
    whole: np.ndarray
    edges: np.ndarray


def write_overlay_bag(path: Path, overlay: Overlay) -> None:
    """Write markers of both shapes over time, for ``rosbag play``.

    Measured points are orange, the simulated object is blue, and lines join what belongs together.
    Points that were not seen are left out. Raises OSError.
    """
    path.unlink(missing_ok=True)
    messages = _Messages()
    shapes = overlay.shapes
    with Writer(path) as bag:
        array = "visualization_msgs/msg/MarkerArray"
        connection = bag.add_connection(_TOPIC, array, typestore=messages.types)
        due = -np.inf
        for frame, time in enumerate(shapes.time):
            if time >= due - 1e-9:
                due = time + 1.0 / _RATE
                # A bag begins after the epoch.
                stamp = round(1e9 * (1.0 + time - shapes.time[0]))
                message = messages.of(stamp, overlay, frame)
                bag.write(connection, stamp, messages.types.serialize_ros1(message, array))


def overlay_configuration(overlay: Overlay) -> str:
    """The text of an RViz file whose views hold all of it."""
    points = np.concatenate((overlay.shapes.points.reshape(-1, 3), overlay.whole.reshape(-1, 3)))
    low, high = np.nanmin(points, axis=0) - _ROOM, np.nanmax(points, axis=0) + _ROOM
    configuration = configuration_around(low, high, _FRAME)
    return yaml.safe_dump(configuration, sort_keys=False, default_flow_style=False, width=1000)


class _Messages:
    """Makes the messages of one time after the other."""

    def __init__(self) -> None:
        self.types = get_typestore(Stores.ROS1_NOETIC)

    def _make(self, name: str, *values):
        return self.types.types[name](*values)

    def of(self, stamp: int, overlay: Overlay, frame: int):
        """A MarkerArray at a time [ns]."""
        header = self._header(stamp)
        seen, guess = overlay.shapes.points[frame], overlay.predicted[frame]
        both = np.isfinite(seen).all(axis=1)
        apart = np.stack((seen[both], guess[both]), axis=1).reshape(-1, 3)
        drawn = overlay.whole[frame][overlay.edges].reshape(-1, 3)
        markers = [
            self._marker(header, "measured", _BALLS, _BALL, _MEASURED, seen[both]),
            self._marker(header, "predicted", _BALLS, _BALL, _PREDICTED, guess),
            self._marker(header, "difference", _LINES, 0.5 * _BALL, _MEASURED, apart),
            self._marker(header, "object", _LINES, _LINE, _PREDICTED, drawn),
        ]
        return self._make("visualization_msgs/msg/MarkerArray", markers)

    def _header(self, stamp: int):
        time = self._make("builtin_interfaces/msg/Time", *divmod(stamp, 10**9))
        return self._make("std_msgs/msg/Header", 0, time, _FRAME)

    def _marker(self, header, namespace, kind, size, colour, points):
        numbers = self._make("geometry_msgs/msg/Vector3", size, size, size)
        point = self.types.types["geometry_msgs/msg/Point"]
        pose = self._make(
            "geometry_msgs/msg/Pose",
            point(0.0, 0.0, 0.0),
            self._make("geometry_msgs/msg/Quaternion", 0.0, 0.0, 0.0, 1.0),
        )
        return self._make(
            "visualization_msgs/msg/Marker",
            header,
            namespace,
            0,  # id
            kind,
            0,  # add
            pose,
            numbers,
            self._make("std_msgs/msg/ColorRGBA", *colour, 1.0),
            self._make("builtin_interfaces/msg/Duration", 0, 0),
            False,  # frame_locked
            [point(*each) for each in points.tolist()],
            [],
            "",
            "",
            False,
        )
