"""The ``motion`` of an obstacle: where its pose comes from."""

import re
from typing import Tuple

from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.names import FRAME
from deformable_manipulation.reading.readers import (
    Node,
    Report,
    Section,
    Text,
    UnitQuaternion,
    position,
    read_items,
)
from deformable_manipulation.scenario.spec import (
    FrameMotion,
    Motion,
    PathMotion,
    PoseWaypoint,
    TopicMotion,
)
from deformable_manipulation.scenario.waypoints import TIME, check_times

POSE_WAYPOINT = Section(
    PoseWaypoint, {"time": TIME, "position": position(), "orientation": UnitQuaternion()}
)
_TOPIC = Text(
    re.compile(r"/?[A-Za-z][A-Za-z0-9_]*(/[A-Za-z][A-Za-z0-9_]*)*"),
    "a ROS topic: names of letters, digits and _ between /",
)


class _PoseWaypoints:
    """A list of waypoints with increasing times."""

    allowed = "a list of waypoints {time: s, position: [x, y, z], orientation: [x, y, z, w]}"

    def __call__(self, node: Node) -> Tuple[PoseWaypoint, ...]:
        if not isinstance(node.value, (list, tuple)) or not node.value:
            node.fail("must be {}".format(self.allowed))
        waypoints = read_items(node, POSE_WAYPOINT)
        check_times(node, waypoints)
        return waypoints


_KINDS = {
    "waypoints": Section(PathMotion, {"waypoints": _PoseWaypoints()}),
    "topic": Section(TopicMotion, {"topic": _TOPIC}),
    "frame": Section(FrameMotion, {"frame": FRAME}),
}


class MotionReader:
    """Exactly one source of poses."""

    fields = {key: section.fields[key] for key, section in _KINDS.items()}
    defaults = {}
    others = ()
    allowed = "a section with one of the keys {}".format(", ".join(_KINDS))

    def __call__(self, node: Node) -> Motion:
        given = [key for key in _KINDS if isinstance(node.value, dict) and key in node.value]
        if len(given) != 1:
            node.fail("must be {}".format(self.allowed))
        return _KINDS[given[0]](node)


MOTION = MotionReader()


def check_frames(report: Report, frame: str, obstacles) -> None:
    """No obstacle is where the fixed frame is: that never moves."""
    for index, obstacle in enumerate(obstacles):
        if isinstance(obstacle.motion, FrameMotion) and obstacle.motion.frame == frame:
            report.add(
                ("obstacles", str(index), "motion", "frame"),
                "must be another frame than the fixed one; leave motion out for an obstacle that "
                "stands",
                show(frame),
            )
