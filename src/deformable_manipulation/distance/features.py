"""The result of a distance computation: nearest features of every copy of the object."""

from dataclasses import dataclass
from typing import Optional, Tuple

import numpy as np

NOT_FOLLOWED = -1  # identity of a feature that has none


@dataclass(frozen=True)
class Distances:
    """Signed distances between C copies of an object and the obstacles.

    The features of copy ``c`` are rows ``offsets[c]:offsets[c + 1]``, the nearest first. A copy
    has none when there is no obstacle; its minimum is then infinite.

    A feature's object point is a material point of the object, a convex combination of its
    geometry points: ``sum_k weights[m, k] * points[copy, vertices[m, k]]``. The same
    ``vertices`` and ``weights`` applied to another copy tell where that point of the object is
    there.
    """

    minimum: np.ndarray  # (C,) m, from the object's surface to the obstacle's; negative: depth
    offsets: np.ndarray  # (C + 1,) int
    distance: np.ndarray  # (M,) m, signed
    obstacle: np.ndarray  # (M,) int, index of the obstacle
    object_point: np.ndarray  # (M, 3) m, on the centre line or mid-surface
    obstacle_point: np.ndarray  # (M, 3) m
    normal: np.ndarray  # (M, 3) unit vector along which the distance grows fastest
    vertices: np.ndarray  # (M, 3) int, geometry points; unused ones have weight 0
    weights: np.ndarray  # (M, 3) non-negative, sum 1
    obstacle_velocity: np.ndarray  # (M, 3) m/s, of the obstacle at its point
    # (M,) int, the same feature has the same number from call to call, or NOT_FOLLOWED; None: all
    identity: Optional[np.ndarray] = None
    names: Tuple[str, ...] = ()  # of the obstacles

    @classmethod
    def unknown(cls, copies: int, names: Tuple[str, ...]) -> "Distances":
        """No features, and minima that are not numbers, where distances cannot be computed."""
        vectors = np.zeros((0, 3))
        return cls(
            minimum=np.full(copies, np.nan),
            offsets=np.zeros(copies + 1, dtype=int),
            distance=np.zeros(0),
            obstacle=np.zeros(0, dtype=int),
            object_point=vectors,
            obstacle_point=vectors,
            normal=vectors,
            vertices=np.zeros((0, 3), dtype=int),
            weights=vectors,
            obstacle_velocity=vectors,
            names=names,
        )

    def of_copy(self, copy: int) -> slice:
        """Rows of the features of one copy."""
        return slice(int(self.offsets[copy]), int(self.offsets[copy + 1]))
