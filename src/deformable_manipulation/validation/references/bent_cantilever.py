"""A cantilever in a vertical plane, curved without load, with a weight at its tip.

With the angle a of the tangent above the x axis, the natural curvature k, the weight w per length
and the weight W at the tip (Antman, Nonlinear Problems of Elasticity, chapter 4):

    EI (a' - k)' = (w (L - s) + W) cos a,   a(0) = 0,   a'(L) = k.

It neither stretches nor shears. Solved by collocation (scipy.integrate.solve_bvp).
"""

from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_bvp

_TOLERANCE = 1e-8
_NODES = 201
_STEPS = 10  # in which the load is put on


@dataclass(frozen=True)
class BentCantilever:
    """A cantilever along x at its root; SI units, see above."""

    length: float
    bending_stiffness: float
    weight_per_length: float
    natural_curvature: float = 0.0
    tip_weight: float = 0.0

    def positions(self, arc_lengths: np.ndarray) -> np.ndarray:
        """Points (n, 2), x and z [m], at arc lengths (n,) [m] from the root."""
        s = np.linspace(0.0, self.length, _NODES)
        k = self.natural_curvature
        state = np.array([k * s, np.full_like(s, k), np.zeros_like(s), np.zeros_like(s)])
        for share in np.linspace(0.0, 1.0, _STEPS + 1):
            solution = self._solve(share, s, state)
            s, state = solution.x, solution.y
        return solution.sol(np.asarray(arc_lengths))[2:].T

    def _solve(self, share: float, s: np.ndarray, state: np.ndarray):
        def derivatives(s, y):
            load = self.weight_per_length * (self.length - s) + self.tip_weight
            bending = share * load * np.cos(y[0]) / self.bending_stiffness
            return np.array([y[1], bending, np.cos(y[0]), np.sin(y[0])])

        def conditions(root, tip):
            return np.array([root[0], tip[1] - self.natural_curvature, root[2], root[3]])

        solution = solve_bvp(derivatives, conditions, s, state, tol=_TOLERANCE, max_nodes=20000)
        if not solution.success:
            raise RuntimeError(f"no cantilever was found for {self}: {solution.message}")
        return solution
