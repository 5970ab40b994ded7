"""The parameters of a rod that can be fitted."""

import dataclasses
import math
from dataclasses import dataclass
from typing import List, Tuple

import numpy as np

from deformable_manipulation.identification.material_parameters import MaterialParameters
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
_MOST_AIM = math.radians(45.0)
_ANGLE_STEP = 0.01  # rad
_CURVATURE_STEP = 0.02  # 1/m
_MOST_BEND = 0.5  # rad from segment to segment, about each axis


@dataclass(frozen=True)
class Parameters(MaterialParameters):
    """Which parameters of a rod are fitted, and what a vector of them means.

    After those of the material come the natural curvatures about the y and the z axis [1/m], if
    they are fitted, and two angles [rad] of each grip's aim. A torsion modulus that is not fitted
    keeps its ratio to ``young_modulus``.

    Attributes:
        grips: number of grips whose aim is fitted.
        curved: whether a natural curvature is fitted; a natural twist stays as it is given.
    """

    spec: RodSpec
    grips: int = 0
    curved: bool = False

    @property
    def names(self) -> List[str]:
        """Of the numbers of the vector."""
        aims = (
            f"aim of grip {grip + 1} about {axis}" for grip in range(self.grips) for axis in "yz"
        )
        bends = [f"natural curvature about {axis}" for axis in "yz"] if self.curved else []
        return [*super().names, *bends, *aims]

    @property
    def _bends(self) -> int:
        return 2 if self.curved else 0

    @property
    def _first_aim(self) -> int:
        return len(self.material) + self._bends

    @property
    def steps(self) -> np.ndarray:
        """See :attr:`.MaterialParameters.steps`."""
        others = [_CURVATURE_STEP] * self._bends + [_ANGLE_STEP] * (2 * self.grips)
        return np.append(super().steps, others)

    def start(self) -> np.ndarray:
        """The vector of the rod as it was given, with straight grips."""
        bends = list(self._shape.curvature) if self.curved else []
        material = MaterialParameters(self.spec, self.material).start()
        return self.bounded(np.append(material, bends + [0.0] * (2 * self.grips)))

    @property
    def _shape(self) -> NaturalShape:
        return self.spec.natural_shape or NaturalShape()

    def bounds(self) -> Tuple[np.ndarray, np.ndarray]:
        """See :meth:`.MaterialParameters.bounds`."""
        bend = _MOST_BEND * self.spec.segments / self.spec.length
        others = np.array([bend] * self._bends + [_MOST_AIM] * (2 * self.grips))
        low, high = super().bounds()
        return np.append(low, -others), np.append(high, others)

    def object_of(self, vector: np.ndarray) -> RodSpec:
        """The rod with these parameters."""
        values = self.values_of(vector)
        if "young_modulus" in values and "torsion_modulus" not in values:
            ratio = self.spec.torsion_modulus / self.spec.young_modulus
            values["torsion_modulus"] = ratio * values["young_modulus"]
        if self.curved:
            bends = vector[len(self.material) : self._first_aim]
            curvature = (float(bends[0]), float(bends[1]))
            values["natural_shape"] = dataclasses.replace(self._shape, curvature=curvature)
        return dataclasses.replace(self.spec, **values)

    def aim_of(self, vector: np.ndarray) -> List[Tuple[float, float]]:
        """See :meth:`.MaterialParameters.aim_of`."""
        angles = list(vector[self._first_aim :])
        return list(zip(angles[::2], angles[1::2]))

    def straight(self, vector: np.ndarray) -> Tuple["Parameters", np.ndarray]:
        """The same without a natural curvature to be fitted, and the vector of it."""
        others = np.delete(vector, range(len(self.material), self._first_aim))
        return dataclasses.replace(self, curved=False), others
