"""The parameters that can be fitted, as a vector of numbers of similar sensitivity."""

import dataclasses
import math
from dataclasses import dataclass
from typing import Any, Dict, List, Tuple

import numpy as np

from deformable_manipulation.objects.natural_shape import NaturalShape
from deformable_manipulation.objects.rod import RodSpec

AIM = "aim"
CURVATURE = "natural_curvature"
MATERIAL = (
    "young_modulus",
    "torsion_modulus",
    "bending_retardation_time",
    "drag_coefficient",
    "damping",
)

# What a parameter starts from if the object has none of it.
_FIRST = {"bending_retardation_time": 0.05, "drag_coefficient": 1.2, "damping": 1.0}
_LEAST = {
    "young_modulus": 1.0,
    "torsion_modulus": 1.0,
    "bending_retardation_time": 1e-3,
    "drag_coefficient": 1e-2,
    "damping": 1e-2,
}
_MOST = {
    "young_modulus": 1e13,
    "torsion_modulus": 1e13,
    "bending_retardation_time": 10.0,
    "drag_coefficient": 100.0,
    "damping": 1e3,
}
_MOST_AIM = math.radians(45.0)
_FACTOR_STEP = 0.02  # of a logarithm, for derivatives
_ANGLE_STEP = 0.01  # rad
_CURVATURE_STEP = 0.02  # 1/m
_MOST_BEND = 0.5  # rad from segment to segment, about each axis


@dataclass(frozen=True)
class Parameters:
    """Which parameters of an object are fitted, and what a vector of them means.

    Those of the material are logarithms of its keys. Then come the natural curvatures about the y
    and the z axis [1/m], if they are fitted, and two angles [rad] of each grip's aim.

    Attributes:
        spec: the object with all other values. A torsion modulus that is not fitted keeps its
            ratio to ``young_modulus``.
        material: keys of the object.
        grips: number of grips whose aim is fitted.
        curved: whether a natural curvature is fitted; a natural twist stays as it is given.
    """

    spec: RodSpec
    material: Tuple[str, ...]
    grips: int
    curved: bool = False

    @property
    def names(self) -> List[str]:
        """Of the numbers of the vector."""
        aims = (
            f"aim of grip {grip + 1} about {axis}" for grip in range(self.grips) for axis in "yz"
        )
        bends = [f"natural curvature about {axis}" for axis in "yz"] if self.curved else []
        return [*self.material, *bends, *aims]

    @property
    def _bends(self) -> int:
        return 2 if self.curved else 0

    @property
    def _first_aim(self) -> int:
        return len(self.material) + self._bends

    @property
    def steps(self) -> np.ndarray:
        """Differences that are small, yet make derivatives that rounding does not disturb."""
        return np.array(
            [_FACTOR_STEP] * len(self.material)
            + [_CURVATURE_STEP] * self._bends
            + [_ANGLE_STEP] * (2 * self.grips)
        )

    def start(self) -> np.ndarray:
        """The vector of the object as it was given, with straight grips."""
        logs = [math.log(getattr(self.spec, key) or _FIRST[key]) for key in self.material]
        bends = list(self._shape.curvature) if self.curved else []
        return self.bounded(np.array(logs + bends + [0.0] * (2 * self.grips)))

    @property
    def _shape(self) -> NaturalShape:
        return self.spec.natural_shape or NaturalShape()

    def bounded(self, vector: np.ndarray) -> np.ndarray:
        """The nearest vector that has a meaning."""
        return np.clip(vector, *self._bounds())

    def at_bounds(self, vector: np.ndarray) -> np.ndarray:
        """Which numbers (P,) of a vector lie at a bound of the search."""
        low, high = self._bounds()
        return (vector <= low) | (vector >= high)

    def _bounds(self) -> Tuple[np.ndarray, np.ndarray]:
        bend = _MOST_BEND * self.spec.segments / self.spec.length
        others = np.array([bend] * self._bends + [_MOST_AIM] * (2 * self.grips))
        low = [math.log(_LEAST[key]) for key in self.material]
        high = [math.log(_MOST[key]) for key in self.material]
        return np.append(low, -others), np.append(high, others)

    def object_of(self, vector: np.ndarray) -> RodSpec:
        """The object with these parameters."""
        values: Dict[str, Any] = {
            key: math.exp(number) for key, number in zip(self.material, vector)
        }
        if "young_modulus" in values and "torsion_modulus" not in values:
            ratio = self.spec.torsion_modulus / self.spec.young_modulus
            values["torsion_modulus"] = ratio * values["young_modulus"]
        if self.curved:
            bends = vector[len(self.material) : self._first_aim]
            curvature = (float(bends[0]), float(bends[1]))
            values["natural_shape"] = dataclasses.replace(self._shape, curvature=curvature)
        return dataclasses.replace(self.spec, **values)

    def aim_of(self, vector: np.ndarray) -> List[Tuple[float, float]]:
        """Angles [rad] of each grip; empty if they are not fitted."""
        angles = list(vector[self._first_aim :])
        return list(zip(angles[::2], angles[1::2]))

    def straight(self, vector: np.ndarray) -> Tuple["Parameters", np.ndarray]:
        """The same without a natural curvature to be fitted, and the vector of it."""
        others = np.delete(vector, range(len(self.material), self._first_aim))
        return dataclasses.replace(self, curved=False), others

    def with_value(self, vector: np.ndarray, key: str, value: float) -> np.ndarray:
        """The vector with another value of one key of the material."""
        changed = np.array(vector)
        changed[self.material.index(key)] = math.log(value)
        return changed
