"""Types of the scenario's values: SI units, angles in rad, quaternions x, y, z, w, the fixed frame."""

from dataclasses import dataclass
from typing import Tuple

from deformable_manipulation.scenario.parameter import parameter
from deformable_manipulation.scenario.readers import UnitQuaternion, position

Vector = Tuple[float, float, float]
Quaternion = Tuple[float, float, float, float]


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
