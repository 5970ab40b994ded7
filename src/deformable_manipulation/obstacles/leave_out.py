"""The section ``leave_out`` of live obstacles: what is seen, but is no obstacle."""

from dataclasses import dataclass
from typing import Tuple

from deformable_manipulation.geometry.pose import Vector
from deformable_manipulation.reading.names import FRAME
from deformable_manipulation.reading.parameter import parameter
from deformable_manipulation.reading.readers import Items, Number, Section, position

_REACH = Number("m", at_least=0.0, at_most=10.0)


@dataclass(frozen=True)
class OwnShape:
    """A capsule that moves along with an agent or a tf frame: a part of a robot."""

    frame: str = parameter(
        FRAME,
        "Name of an agent, whose held point and orientation it moves along with, or else a tf "
        "frame.",
    )
    start: Vector = parameter(position(), "One end of its axis, in that frame.")
    end: Vector = parameter(position(), "The other end; the same makes it a ball.")
    radius: float = parameter(
        Number("m", above=0.0, at_most=10.0),
        "Around its axis. Make it as large as the part, and as the camera is off.",
    )


OWN_SHAPE = Section(OwnShape)


@dataclass(frozen=True)
class LeaveOut:
    """Points of the data that belong to what is carried, and to those who carry it."""

    object: float = parameter(
        _REACH,
        "Points that are nearer than this to the surface of the modelled object are taken for its "
        "own. Make it larger than what the model is off, and than the camera's noise, unless the "
        "obstacle has a `noise`.",
        default=0.02,
        allowed="below `controller.collision.offset`",
    )
    grips: float = parameter(
        _REACH,
        "Points that are nearer than this to a held point are taken for a gripper.",
        default=0.0,
    )
    shapes: Tuple[OwnShape, ...] = parameter(
        Items(OWN_SHAPE), "Parts of the robots, see below.", default=(), default_text="`[]`"
    )


LEAVE_OUT = Section(LeaveOut)
