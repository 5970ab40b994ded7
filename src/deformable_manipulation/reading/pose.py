"""Poses in the scenario."""

from dataclasses import dataclass

from deformable_manipulation.geometry.pose import Quaternion, Vector
from deformable_manipulation.reading.parameter import parameter
from deformable_manipulation.reading.readers import Section, UnitQuaternion, position


@dataclass(frozen=True)
class Pose:
    """Position [m] and orientation (unit quaternion x, y, z, w)."""

    position: Vector = parameter(
        position(),
        "First end of the undeformed rod; origin of the fabric's mesh.",
        default=(0.0, 0.0, 0.0),
    )
    orientation: Quaternion = parameter(
        UnitQuaternion(),
        "Turns x into the rod's direction; `[0, 0, 0.7071, 0.7071]` lays it along y.",
        default=(0.0, 0.0, 0.0, 1.0),
    )


POSE = Section(Pose)
