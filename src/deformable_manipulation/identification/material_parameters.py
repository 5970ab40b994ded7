"""Parameters of a material that can be fitted, as a vector of numbers of similar sensitivity."""

import dataclasses
import math
from dataclasses import dataclass
from typing import Any, Dict, List, Tuple, Union

import numpy as np

from deformable_manipulation.objects.fabric import FabricSpec
from deformable_manipulation.objects.rod import RodSpec


@dataclass(frozen=True)
class Range:
    """What the search may make of a key of the object, and what it starts from without a value."""

    least: float
    most: float
    first: float = 0.0  # where the object has none of it


RANGES = {
    "young_modulus": Range(1.0, 1e13),
    "torsion_modulus": Range(1.0, 1e13),
    "bending_retardation_time": Range(1e-3, 10.0, 0.05),
    "drag_coefficient": Range(1e-2, 100.0, 1.2),
    "damping": Range(1e-2, 1e3, 1.0),
    "stretching_compliance": Range(1e-7, 1.0, 1e-3),
    "bending_compliance": Range(1e-2, 1e10, 1e4),
}
OF_FABRICS = ("stretching_compliance", "bending_compliance", "damping")
_FACTOR_STEP = 0.02  # of a logarithm, for derivatives


@dataclass(frozen=True)
class MaterialParameters:
    """Which keys of an object are fitted, and what a vector of their logarithms means.

    Attributes:
        spec: the object with all other values.
        material: keys of the object.
    """

    spec: Union[RodSpec, FabricSpec]
    material: Tuple[str, ...]

    @property
    def names(self) -> List[str]:
        """Of the numbers of the vector."""
        return list(self.material)

    @property
    def steps(self) -> np.ndarray:
        """Differences that are small, yet make derivatives that rounding does not disturb."""
        return np.full(len(self.material), _FACTOR_STEP)

    def start(self) -> np.ndarray:
        """The vector of the object as it was given."""
        values = (getattr(self.spec, key) or RANGES[key].first for key in self.material)
        return self.bounded(np.array([math.log(value) for value in values]))

    def bounded(self, vector: np.ndarray) -> np.ndarray:
        """The nearest vector that has a meaning."""
        return np.clip(vector, *self.bounds())

    def at_bounds(self, vector: np.ndarray) -> np.ndarray:
        """Which numbers (P,) of a vector lie at a bound of the search."""
        low, high = self.bounds()
        return (vector <= low) | (vector >= high)

    def bounds(self) -> Tuple[np.ndarray, np.ndarray]:
        """Of the numbers of the vector (P,)."""
        ranges = [RANGES[key] for key in self.material]
        return (
            np.log([each.least for each in ranges]),
            np.log([each.most for each in ranges]),
        )

    def object_of(self, vector: np.ndarray) -> Union[RodSpec, FabricSpec]:
        """The object with these parameters."""
        return dataclasses.replace(self.spec, **self.values_of(vector))

    def values_of(self, vector: np.ndarray) -> Dict[str, Any]:
        """Values of the keys of the material."""
        return {key: math.exp(number) for key, number in zip(self.material, vector)}

    def aim_of(self, vector: np.ndarray) -> List[Tuple[float, float]]:
        """Angles [rad] of each grip; empty if they are not fitted."""
        return []

    def with_value(self, vector: np.ndarray, key: str, value: float) -> np.ndarray:
        """The vector with another value of one key of the material."""
        changed = np.array(vector)
        changed[self.material.index(key)] = math.log(value)
        return changed
