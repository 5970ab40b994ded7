"""Whether an object is as large as its material makes it, or was torn beyond what is simulated."""

import math
from typing import Optional

import numpy as np

from deformable_manipulation.scenario.spec import Scenario


class StretchGauge:
    """Tells the relative change of length of the edge of an object that is changed most.

    Edges are a rod's segments, and a fabric's sides of triangles.

    Args:
        spec: the object.
    """

    def __init__(self, spec):
        edges, lengths = spec.edges()
        self._squared_lengths = lengths**2
        self._first, self._second = np.ascontiguousarray(edges.T)

    def measure(self, points: np.ndarray) -> float:
        """The largest change [1], with its sign.

        Args:
            points: (P, 3) geometry points [m].
        """
        edges = points.take(self._second, axis=0) - points.take(self._first, axis=0)
        ratios = np.einsum("ei,ei->e", edges, edges) / self._squared_lengths
        longest = math.sqrt(ratios.max()) - 1.0
        shortest = math.sqrt(ratios.min()) - 1.0
        return longest if longest >= -shortest else shortest


def valid_stretch(scenario: Scenario) -> float:
    """The largest relative change of length [1] that the scenario's object in use has."""
    return scenario.object.valid_stretch(scenario.simulation.gravity)


def largest_stretch(stretches: np.ndarray) -> Optional[float]:
    """The largest size of the changes of length of a run [1], None where there is none."""
    finite = stretches[np.isfinite(stretches)]
    return float(np.abs(finite).max()) if finite.size else None
