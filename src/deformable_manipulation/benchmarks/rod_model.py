"""What the rod of every library offers to the trial."""

from abc import abstractmethod
from typing import Any, Dict

import numpy as np

from deformable_manipulation.benchmarks.trial import Model, UndampedModel


class RodModel(Model):
    """A rod whose points (n, 2) are x and z [m] from the first grip.

    Attributes:
        free_length: length [m] from grip to grip, or from clamp to tip. A rod that is held in the
            middle of a segment begins there.
        overhang: length [m] of the stub beyond a grip.
    """

    free_length: float
    overhang = 0.0

    @abstractmethod
    def place_end(self, x: float, velocity: float) -> None:
        """Put the held last end at (x, 0, 0) [m] from the first, for the next step [m/s]."""

    @abstractmethod
    def arc_lengths(self) -> np.ndarray:
        """Arc lengths (n,) [m] of the points from the first grip."""

    def measures(self) -> Dict[str, Any]:
        return {
            "arc_lengths": np.asarray(self.arc_lengths()).tolist(),
            "free_length": self.free_length,
            "overhang": self.overhang,
        }


class UndampedRodModel(UndampedModel, RodModel):
    """A rod in a library that has no damping."""
