"""Whether an object is as large as its material makes it, or was torn beyond what is simulated."""

import math
from functools import singledispatch
from typing import Optional, Tuple

import numpy as np

from deformable_manipulation.scenario.spec import FabricSpec, RodSpec, Scenario

# Ropes and rods yield less than a thousandth to any load in use; what is longer has been pulled
# apart, and its shape and distances mean nothing.
LARGEST_VALID_STRETCH = 0.01

_LARGEST_PULL = 10.0  # times the weight of a fabric


class StretchGauge:
    """Tells the relative change of length of the edge of an object that is changed most.

    Edges are a rod's segments, and a fabric's sides of triangles.

    Args:
        spec: RodSpec or FabricSpec.
    """

    def __init__(self, spec):
        edges, lengths = _edges(spec)
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


@singledispatch
def _edges(spec) -> Tuple[np.ndarray, np.ndarray]:
    """Indices of the points at the ends (E, 2) and undeformed lengths (E,) [m] of all edges."""
    raise TypeError("no edges of objects of {}".format(type(spec).__name__))


@_edges.register(RodSpec)
def _segments(spec: RodSpec):
    ends = np.arange(spec.segments)
    return np.stack((ends, ends + 1), axis=1), np.full(spec.segments, spec.length / spec.segments)


@_edges.register(FabricSpec)
def _sides(spec: FabricSpec):
    triangles = np.array(spec.triangles)
    sides = np.concatenate((triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]))
    edges = np.unique(np.sort(sides, axis=1), axis=0)
    vertices = np.array(spec.vertices)
    return edges, np.linalg.norm(vertices[edges[:, 1]] - vertices[edges[:, 0]], axis=1)


def valid_stretch(scenario: Scenario) -> float:
    """The largest relative change of length [1] that an object in use has.

    A fabric's edges yield, besides what rods are granted, by what a pull of ten times its weight
    makes of an edge of mean length: 10 x compliance x weight / length. Held by corners at 99 % of
    its size, a fabric pulls on them by several times its weight.
    """
    spec = scenario.object
    if isinstance(spec, RodSpec):
        return LARGEST_VALID_STRETCH
    corners = np.array(spec.vertices)[np.array(spec.triangles)]
    doubled = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = 0.5 * np.linalg.norm(doubled, axis=1).sum()
    weight = spec.density * area * np.linalg.norm(scenario.simulation.gravity)
    mean_length = _edges(spec)[1].mean()
    pulled = _LARGEST_PULL * spec.stretching_compliance * weight / mean_length
    return float(LARGEST_VALID_STRETCH + pulled)


def largest_stretch(stretches: np.ndarray) -> Optional[float]:
    """The largest size of the changes of length of a run [1], None where there is none."""
    finite = stretches[np.isfinite(stretches)]
    return float(np.abs(finite).max()) if finite.size else None
