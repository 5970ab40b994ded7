"""The ``leader`` section: its scripted path, and the limits of its motion by hand."""

import math
from dataclasses import dataclass
from typing import Optional, Tuple

from deformable_manipulation.geometry.pose import Quaternion, Vector
from deformable_manipulation.geometry.rotation import conjugate, multiply, to_vector
from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.parameter import parameter
from deformable_manipulation.reading.readers import (
    Node,
    Number,
    Section,
    UnitQuaternion,
    position,
    read_items,
)
from deformable_manipulation.reading.times import SHORTEST_PIECE, TIME, check_times

_LARGEST_SPEED = 5.0  # m/s, mean between waypoints: twice that is refused as a command
_LARGEST_TURN_RATE = 4.0  # rad/s, likewise: orientations that leap stop the assistants at 10 rad/s
_UNTURNED = (0.0, 0.0, 0.0, 1.0)
_SMALL_TURN = 1e-9  # rad


@dataclass(frozen=True)
class Waypoint:
    """Where the leader is at a time, relative to its start."""

    time: float = parameter(
        TIME,
        "When the leader is there.",
        allowed="the first 0, then increasing by at least 0.001",
    )
    position: Vector = parameter(
        position(),
        "Where it is, relative to its start.",
        allowed="the first `[0, 0, 0]`, then within 5 m/s of the one before",
    )
    orientation: Quaternion = parameter(
        UnitQuaternion(),
        "How far its grip is turned there, after `orientation` of the agent, about the axes of the "
        "fixed frame. From one waypoint to the next it turns the shorter way round. Assistants "
        "turn with it with `controller.orientation: follow`.",
        default=_UNTURNED,
        allowed="the first `[0, 0, 0, 1]`, then within 4 rad/s of the one before; all are so with "
        "`controller.orientation: fixed`",
    )

    @property
    def is_turned(self) -> bool:
        """Whether its orientation is not that of the start."""
        return math.hypot(*to_vector(self.orientation)) > _SMALL_TURN


WAYPOINT = Section(Waypoint)


class Waypoints:
    """A list of waypoints: times increasing, the first at time 0 and at the leader's start."""

    type, unit, range = "list", "", "one or more"
    allowed = (
        "a list of waypoints {time: s, position: [x, y, z], orientation: [x, y, z, w]}, the first "
        "at time 0"
    )

    def __call__(self, node: Node) -> Tuple[Waypoint, ...]:
        if not isinstance(node.value, (list, tuple)) or not node.value:
            node.fail("must be {}".format(self.allowed))
        waypoints = read_items(node, WAYPOINT)
        _check_first(node, waypoints[0])
        check_times(node, waypoints)
        _check_speeds(node, waypoints)
        return waypoints


def _check_first(node: Node, first: Waypoint) -> None:
    if first.time != 0.0:
        node.report.add(node.path + ("0", "time"), "must be 0", show(first.time))
    if any(first.position):
        node.report.add(
            node.path + ("0", "position"),
            "must be [0, 0, 0]: positions are relative to the leader's start",
            show(list(first.position)),
        )
    if first.is_turned:
        node.report.add(
            node.path + ("0", "orientation"),
            "must be [0, 0, 0, 1]: orientations are relative to the leader's start",
            show(list(first.orientation)),
        )


def _check_speeds(node: Node, waypoints: Tuple[Waypoint, ...]) -> None:
    for index, (before, waypoint) in enumerate(zip(waypoints, waypoints[1:]), start=1):
        duration = waypoint.time - before.time
        farthest = _LARGEST_SPEED * duration
        if duration < SHORTEST_PIECE:
            continue  # reported
        if math.dist(waypoint.position, before.position) > farthest:
            node.report.add(
                node.path + (str(index), "position"),
                "must be at most {:.4g} m from the waypoint before, {:g} m/s in {:g} s".format(
                    farthest, _LARGEST_SPEED, duration
                ),
                show(list(waypoint.position)),
            )
        turn = multiply(waypoint.orientation, conjugate(before.orientation))
        most = _LARGEST_TURN_RATE * duration
        if math.hypot(*to_vector(turn)) > most:
            node.report.add(
                node.path + (str(index), "orientation"),
                "must be at most {:.4g} rad from the waypoint before, {:g} rad/s in {:g} s".format(
                    most, _LARGEST_TURN_RATE, duration
                ),
                show(list(waypoint.orientation)),
            )


@dataclass(frozen=True)
class WorkspaceSpec:
    """A box along the axes of the fixed frame."""

    lower: Vector = parameter(
        position(),
        "One corner of the box, in the fixed frame.",
        allowed="below `upper` in each axis",
    )
    upper: Vector = parameter(position(), "The opposite corner.")


WORKSPACE = Section(WorkspaceSpec)


class Workspace:
    """A box of some size, or ``auto`` (None)."""

    type, unit, range = "section or `auto`", "", ""
    allowed = "a section {lower: [x, y, z], upper: [x, y, z]}, or auto"

    def __call__(self, node: Node) -> Optional[WorkspaceSpec]:
        if node.value == "auto":
            return None
        box = WORKSPACE(node)
        for axis, low, high in zip("xyz", box.lower, box.upper):
            if low >= high:
                node.fail(f"must have its lower corner below its upper one in {axis}")
        return box


@dataclass(frozen=True)
class LeaderSpec:
    """The leader's scripted path, smooth between the waypoints, at rest before and after.

    The other keys are limits of the leader moved by hand, not of the path.
    """

    waypoints: Tuple[Waypoint, ...] = parameter(
        Waypoints(), "The path: smooth between the waypoints, at rest after the last."
    )
    workspace: Optional[WorkspaceSpec] = parameter(
        Workspace(),
        "Where the leader can be moved by hand. `auto`: up to 0.5 m around the path.",
        default=None,
        allowed="holds the leader's start",
    )
    max_velocity: float = parameter(
        Number("m/s", above=0.0, at_most=_LARGEST_SPEED),
        "Bound on every component of the leader's velocity when it is moved by hand. Keep it below "
        "the assistants' `controller.max_velocity`, so that they can follow and give way.",
        default=0.1,
    )
    max_acceleration: float = parameter(
        Number("m/s^2", above=0.0, at_most=1e3),
        "Bound on every component of its change. The assistants see the leader's velocity two "
        "cycles late.",
        default=0.25,
    )


LEADER_PATH = Section(LeaderSpec)
