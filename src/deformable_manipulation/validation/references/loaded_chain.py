"""A perfectly flexible, inextensible chain between two points with a weight at one place.

The horizontal force H is the same all along. The vertical one falls by the weight per length w, and
by the point's weight where that is; the tangent is along both. Each of the two pieces is a
catenary.
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import root


@dataclass(frozen=True)
class LoadedChain:
    """A chain from the origin to (width, height); lengths [m], weights [N/m] and [N]."""

    length: float
    width: float
    height: float
    weight_per_length: float
    at: float
    point_weight: float

    def forces(self) -> np.ndarray:
        """Pull (2,) [N] of the chain on what holds it at the origin, x and z."""
        scale = self.weight_per_length * self.length + self.point_weight

        def missing(pull):
            end = self._reached(pull * scale, np.array([self.length]))[0]
            return (end - [self.width, self.height]) / self.length

        solution = root(missing, [0.5, -0.5], tol=1e-13)
        if not solution.success:
            raise RuntimeError(f"no chain was found for {self}: {solution.message}")
        return solution.x * scale

    def positions(self, arc_lengths: np.ndarray) -> np.ndarray:
        """Points (n, 2), x and z [m], at arc lengths (n,) [m] from the origin."""
        return self._reached(self.forces(), np.asarray(arc_lengths, dtype=float))

    def _reached(self, pull: np.ndarray, s: np.ndarray) -> np.ndarray:
        before = np.minimum(s, self.at)
        # What is behind hangs on the tension, which points along the tangent.
        after = pull + [0.0, self.weight_per_length * self.at + self.point_weight]
        return self._piece(pull, before) + self._piece(after, s - before)

    def _piece(self, pull: np.ndarray, s: np.ndarray) -> np.ndarray:
        """How far (n, 2) [m] a piece leads whose first tension is (2,) [N]."""
        horizontal, w = pull[0], self.weight_per_length
        first, last = pull[1], pull[1] + w * s
        x = horizontal / w * (np.arcsinh(last / horizontal) - np.arcsinh(first / horizontal))
        z = (np.hypot(horizontal, last) - np.hypot(horizontal, first)) / w
        return np.stack([x, z], axis=-1)
