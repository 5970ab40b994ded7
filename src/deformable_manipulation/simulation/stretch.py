"""Whether an object keeps its size, or is stretched so far that its simulation is not valid."""

import math
from typing import Optional

import numpy as np

from deformable_manipulation.scenario.spec import Scenario


class StretchGauge:
    """Measures the largest relative change of length of an edge of an object.

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
    """The largest relative change of length [1] at which the scenario's object is valid."""
    return scenario.object.valid_stretch(scenario.simulation.gravity)


def largest_stretch(stretches: np.ndarray) -> Optional[float]:
    """The largest size of the changes of length of a run [1], None if there is none."""
    finite = stretches[np.isfinite(stretches)]
    return float(np.abs(finite).max()) if finite.size else None
