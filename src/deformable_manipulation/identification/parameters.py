"""The parameters that can be fitted, as a vector of numbers of similar sensitivity."""

import dataclasses
import math
from dataclasses import dataclass
from typing import Any, Dict, List, Tuple

import numpy as np

from deformable_manipulation.objects.rod import RodSpec

AIM = "aim"
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


@dataclass(frozen=True)
class Parameters:
    """Which parameters of an object are fitted, and what a vector of them means.

    Those of the material are logarithms of its keys, then come two angles [rad] of each grip's aim.

    Attributes:
        spec: the object with all other values. A torsion modulus that is not fitted keeps its
            ratio to ``young_modulus``.
        material: keys of the object.
        grips: number of grips whose aim is fitted.
    """

    spec: RodSpec
    material: Tuple[str, ...]
    grips: int

    @property
    def names(self) -> List[str]:
        """Of the numbers of the vector."""
        aims = (
            f"aim of grip {grip + 1} about {axis}" for grip in range(self.grips) for axis in "yz"
        )
        return [*self.material, *aims]

    @property
    def steps(self) -> np.ndarray:
        """Differences that are small, yet make derivatives that rounding does not disturb."""
        return np.array([_FACTOR_STEP] * len(self.material) + [_ANGLE_STEP] * (2 * self.grips))

    def start(self) -> np.ndarray:
        """The vector of the object as it was given, with straight grips."""
        logs = [math.log(getattr(self.spec, key) or _FIRST[key]) for key in self.material]
        return self.bounded(np.array(logs + [0.0] * (2 * self.grips)))

    def bounded(self, vector: np.ndarray) -> np.ndarray:
        """The nearest vector that has a meaning."""
        return np.clip(vector, *self._bounds())

    def at_bounds(self, vector: np.ndarray) -> np.ndarray:
        """Which numbers (P,) of a vector lie at a bound of the search."""
        low, high = self._bounds()
        return (vector <= low) | (vector >= high)

    def _bounds(self) -> Tuple[np.ndarray, np.ndarray]:
        aims = np.full(2 * self.grips, _MOST_AIM)
        low = [math.log(_LEAST[key]) for key in self.material]
        high = [math.log(_MOST[key]) for key in self.material]
        return np.append(low, -aims), np.append(high, aims)

    def object_of(self, vector: np.ndarray) -> RodSpec:
        """The object with these parameters."""
        values: Dict[str, Any] = {
            key: math.exp(number) for key, number in zip(self.material, vector)
        }
        if "young_modulus" in values and "torsion_modulus" not in values:
            ratio = self.spec.torsion_modulus / self.spec.young_modulus
            values["torsion_modulus"] = ratio * values["young_modulus"]
        return dataclasses.replace(self.spec, **values)

    def aim_of(self, vector: np.ndarray) -> List[Tuple[float, float]]:
        """Angles [rad] of each grip; empty if they are not fitted."""
        angles = list(vector[len(self.material) :])
        return list(zip(angles[::2], angles[1::2]))

    def with_value(self, vector: np.ndarray, key: str, value: float) -> np.ndarray:
        """The vector with another value of one key of the material."""
        changed = np.array(vector)
        changed[self.material.index(key)] = math.log(value)
        return changed
