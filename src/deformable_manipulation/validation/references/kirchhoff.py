"""Kirchhoff rod in space, clamped at both ends: a boundary value problem.

With the position r, the orientation q (quaternion that turns x into the tangent t), internal force
n and moment m of the part ahead on the part behind, weight w per length against the z axis:

    r' = t,  q' = (u, 0) q / 2,  n' = w e_z,  m' = n x t,
    u = R u0 + m / EI + (1/GJ - 1/EI) (t . m) t.

All vectors are in the fixed frame but u0, the twist and the curvatures of the rod without load,
which the rotation R of q turns there; the rod neither stretches nor shears.
See S. S. Antman: Nonlinear Problems of Elasticity, chapter 8. Solved in units of the length and of
EI / length^2 by collocation (scipy.integrate.solve_bvp).
"""

from dataclasses import dataclass, replace
from typing import Sequence

import numpy as np
from scipy.integrate import solve_bvp, solve_ivp
from scipy.spatial.transform import Rotation

TOLERANCE = 1e-7
TOLERANCE_ON_THE_WAY = 1e-4
MAX_NODES = 20000
NODES = 201


@dataclass(frozen=True)
class Ends:
    """Where both ends are: the first at the origin along x, the last at a place and rotation.

    ``rotation`` turns the last end's frame from that of the straight rod along x. Its rotation
    vector may be longer than pi: neighbouring solutions are followed.
    """

    position: Sequence[float]  # (3,) [m]
    rotation: Sequence[float] = (0.0, 0.0, 0.0)  # (3,) [rad] rotation vector


class KirchhoffRod:
    """A solution, in SI units; arc lengths are measured from the first end."""

    def __init__(self, length: float, stiffness: float, bvp):
        self.length = length
        self.bvp = bvp
        self._force = stiffness / length**2

    def positions(self, arc_lengths) -> np.ndarray:
        """Points (n, 3) [m]."""
        return self.length * self._state(arc_lengths)[0:3].T

    def forces(self, arc_lengths) -> np.ndarray:
        """Forces (n, 3) [N] of the part ahead on the part behind."""
        return self._force * self._state(arc_lengths)[7:10].T

    def moments(self, arc_lengths) -> np.ndarray:
        """Moments (n, 3) [N m] of the part ahead on the part behind."""
        return self._force * self.length * self._state(arc_lengths)[10:13].T

    def _state(self, arc_lengths) -> np.ndarray:
        return self.bvp.sol(np.asarray(arc_lengths, dtype=float) / self.length)


@dataclass(frozen=True)
class KirchhoffProblem:
    """A rod of length [m], E I and G J [N m^2], weight per length [N/m].

    ``natural``: twist [rad/m] and curvatures about the y and z axis of its frames [1/m].
    """

    length: float
    bending_stiffness: float
    torsion_stiffness: float
    weight: float = 0.0
    natural: Sequence[float] = (0.0, 0.0, 0.0)

    def follow(self, path: Sequence[Ends], nodes: np.ndarray, guess: np.ndarray) -> KirchhoffRod:
        """Solve for ends along a path, each from the solution before; returns the last.

        nodes (n,) and guess (13, n): arc lengths and state in units of the length and of EI /
        length^2. Raises RuntimeError if a solution is not found.
        """
        for ends in path:
            bvp = self._solve(ends, nodes, guess, TOLERANCE_ON_THE_WAY)
            nodes, guess = bvp.x, bvp.y
        bvp = self._solve(ends, nodes, guess, TOLERANCE)
        return KirchhoffRod(self.length, self.bending_stiffness, bvp)

    def hang_freely(self, steps: int) -> KirchhoffRod:
        """The rod clamped at its first end alone, its weight put on in a number of steps."""
        unloaded = replace(self, weight=0.0)
        nodes = self.nodes()
        free = solve_ivp(
            lambda s, y: unloaded._derivatives(s, y[:, None])[:, 0],
            (0.0, 1.0),
            np.concatenate([[0.0] * 6, [1.0], [0.0] * 6]),
            t_eval=nodes,
            rtol=1e-9,
            atol=1e-10,
        )
        guess = free.y
        for weight in np.linspace(0.0, self.weight, steps + 1)[1:]:
            bvp = replace(self, weight=weight)._solve_free(nodes, guess)
            nodes, guess = bvp.x, bvp.y
        return KirchhoffRod(self.length, self.bending_stiffness, bvp)

    def _solve_free(self, nodes: np.ndarray, guess: np.ndarray):
        def conditions(first, last):
            start = np.array([0.0, 0.0, 0.0, 1.0])
            return np.concatenate([first[:3], first[3:7] - start, last[7:13]])

        bvp = solve_bvp(
            self._derivatives, conditions, nodes, guess, tol=TOLERANCE, max_nodes=MAX_NODES
        )
        if not bvp.success:
            raise RuntimeError(f"no Kirchhoff rod with a free end was found: {bvp.message}")
        return bvp

    def planar_guess(self, shape) -> np.ndarray:
        """State (13, NODES) of a planar solution (an ``Elastica`` of the same rod)."""
        nodes = self.nodes()
        arcs = nodes * self.length
        x, z = shape.positions(arcs).T / self.length
        half = 0.5 * shape.angles(arcs)
        force = shape.forces(arcs).T * self.length**2 / self.bending_stiffness
        moment = shape.moments(arcs) * self.length / self.bending_stiffness
        zero = np.zeros_like(nodes)
        # From x towards z is against the y axis.
        rotation = [zero, -np.sin(half), zero, np.cos(half)]
        return np.array([x, zero, z, *rotation, force[0], zero, force[1], zero, -moment, zero])

    @staticmethod
    def nodes() -> np.ndarray:
        """Arc lengths (NODES,) of a guess, in units of the length."""
        return np.linspace(0.0, 1.0, NODES)

    def _solve(self, ends: Ends, nodes: np.ndarray, guess: np.ndarray, tolerance: float):
        place = np.asarray(ends.position, dtype=float) / self.length
        turned_back = Rotation.from_rotvec(ends.rotation).inv().as_quat()

        def conditions(first, last):
            away = quaternion_product(turned_back, last[3:7])[:3]
            start = np.array([0.0, 0.0, 0.0, 1.0])
            return np.concatenate([first[:3], first[3:7] - start, last[:3] - place, away])

        bvp = solve_bvp(
            self._derivatives, conditions, nodes, guess, tol=tolerance, max_nodes=MAX_NODES
        )
        if not bvp.success:
            raise RuntimeError(f"no Kirchhoff rod was found for {ends}: {bvp.message}")
        return bvp

    def _derivatives(self, _, y: np.ndarray) -> np.ndarray:
        q, n, m = y[3:7], y[7:10], y[10:13]
        t = tangents(q)
        ratio = self.bending_stiffness / self.torsion_stiffness - 1.0
        rate = m + ratio * np.sum(t * m, axis=0) * t
        natural = self.length * np.tile(np.asarray(self.natural, dtype=float), (len(q.T), 1))
        rate = rate + turned(q, natural.T)
        turning = 0.5 * quaternion_product(np.vstack([rate, np.zeros_like(rate[0])]), q)
        weight = np.zeros_like(n)
        weight[2] = self.weight * self.length**3 / self.bending_stiffness
        return np.vstack([t, turning, weight, np.cross(n, t, axis=0)])


def quaternion_product(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Hamilton product of quaternions (4,) or (4, n), components x, y, z, w first."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return np.array(
        [
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw,
            aw * bw - ax * bx - ay * by - az * bz,
        ]
    )


def turned(q: np.ndarray, vectors: np.ndarray) -> np.ndarray:
    """Vectors (3, n) turned by quaternions (4, n); not divided by their norm."""
    back = q * np.array([[-1.0], [-1.0], [-1.0], [1.0]])
    pure = np.vstack([vectors, np.zeros_like(vectors[0])])
    return quaternion_product(quaternion_product(q, pure), back)[:3]


def tangents(q: np.ndarray) -> np.ndarray:
    """The x axes (3, n) that quaternions (4, n) turn to; not divided by their norm."""
    x, y, z, w = q
    return np.array([w * w + x * x - y * y - z * z, 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)])
