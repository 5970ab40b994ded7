"""Rigid segments with elastic joints at rest: what a rod of N segments can reach at best.

Planar. Segments of length l have angles a_i above x and their weight w l at their centres; a joint
stores E I / l (1 - cos(a_i+1 - a_i)), which is E I l / 2 times the square of the discrete curvature
2/l sin(da/2) (Deul et al. 2018). Segments are held at their centres. The energy is stationary under
that (Lagrange's multipliers are the forces of the grips); scipy.optimize.root solves the equations
with their exact derivative.
"""

from dataclasses import dataclass
from typing import Sequence

import numpy as np
from scipy.optimize import root

from deformable_manipulation.validation.references.elastica import Clamped, Elastica, End


@dataclass(frozen=True)
class DiscreteChain:
    """Angles (N,) [rad] of segments of a length [m], the first centre at the origin.

    ``grip_forces`` (A, 2) [N] is what the chain exerts on its grips.
    """

    angles: np.ndarray
    segment_length: float
    grip_forces: np.ndarray

    def centres(self) -> np.ndarray:
        """Centres (N, 2) of the segments, x and z [m]."""
        halves = self._halves()
        return np.vstack([np.zeros(2), np.cumsum(halves[:-1] + halves[1:], axis=0)])

    def joints(self) -> np.ndarray:
        """Joints (N - 1, 2) between the segments, x and z [m]."""
        return (self.centres() + self._halves())[:-1]

    def _halves(self) -> np.ndarray:
        directions = np.stack([np.cos(self.angles), np.sin(self.angles)], axis=-1)
        return 0.5 * self.segment_length * directions


@dataclass(frozen=True)
class ChainProblem:
    """A chain of segments of a length [m], held at its first, its last and other segments.

    grips (A,): segments, in their order, the first 0, the last N - 1; places (A, 2) [m] of their
    centres, the first the origin; clamped: angle [rad] by segment, of those that cannot turn.
    stiffness E I [N m^2], weight per length [N/m].
    """

    segment_length: float
    stiffness: float
    weight: float
    grips: Sequence[int]
    places: np.ndarray
    clamped: dict

    def solve(self, guess: np.ndarray) -> DiscreteChain:
        """Find the equilibrium next to angles (N,) [rad].

        Raises:
            RuntimeError: there is none.
        """
        guess = np.array(guess)
        free = np.ones(self._count, dtype=bool)
        for segment, angle in self.clamped.items():
            guess[segment] = angle
            free[segment] = False

        def complete(unknowns):
            angles = guess.copy()
            angles[free] = unknowns[: free.sum()]
            return angles, unknowns[free.sum() :]

        def residual(unknowns):
            angles, forces = complete(unknowns)
            return self._residual(angles, forces, free)

        def derivative(unknowns):
            angles, forces = complete(unknowns)
            return self._derivative(angles, forces, free)

        closing = self._closing(guess)[:, free]
        forces = np.linalg.lstsq(closing.T, self._gradient(guess)[free], rcond=None)[0]
        solution = root(
            residual,
            np.concatenate([guess[free], forces]),
            jac=derivative,
            tol=1e-13,
        )
        total = self.weight * self.segment_length * self._count
        if np.abs(residual(solution.x)).max() > 1e-9 * total * self.segment_length * self._count:
            raise RuntimeError(f"no chain at rest was found: {solution.message}")
        angles, forces = complete(solution.x)
        forces = forces.reshape(2, -1).T
        first = forces.sum(axis=0) - [0.0, total]
        return DiscreteChain(angles, self.segment_length, np.vstack([first, -forces]))

    @property
    def _count(self) -> int:
        return self.grips[-1] + 1

    def _lift(self) -> np.ndarray:
        """Potential energy (N,) per sine: a segment lifts half of itself and all after it.

        The first one turns about its centre and lifts the others alone.
        """
        lifted = np.arange(self._count - 0.5, 0.0, -1.0)
        lifted[0] = 0.5 * (self._count - 1)
        return self.weight * self.segment_length**2 * lifted

    def _levers(self) -> np.ndarray:
        """How far each segment (N) reaches towards each grip after the first (A - 1)."""
        segments = np.arange(self._count)
        grips = np.asarray(self.grips[1:])[:, None]
        levers = self.segment_length * ((segments < grips) + 0.5 * (segments == grips))
        levers[:, 0] = 0.5 * self.segment_length
        return levers

    def _gradient(self, angles: np.ndarray) -> np.ndarray:
        """Derivative (N,) of the energy."""
        moments = self.stiffness / self.segment_length * np.sin(np.diff(angles))
        gradient = self._lift() * np.cos(angles)
        gradient[:-1] -= moments
        gradient[1:] += moments
        return gradient

    def _closing(self, angles: np.ndarray) -> np.ndarray:
        """Derivative (2 (A - 1), N) of the grips' places, all x before all z."""
        levers = self._levers()
        return np.vstack([-levers * np.sin(angles), levers * np.cos(angles)])

    def _residual(self, angles, forces, free) -> np.ndarray:
        levers = self._levers()
        reached = np.concatenate([levers @ np.cos(angles), levers @ np.sin(angles)])
        stationary = self._gradient(angles) - self._closing(angles).T @ forces
        return np.concatenate([stationary[free], reached - self.places[1:].T.ravel()])

    def _derivative(self, angles, forces, free) -> np.ndarray:
        x, z = forces.reshape(2, -1) @ self._levers()
        joints = self.stiffness / self.segment_length * np.cos(np.diff(angles))
        diagonal = (z - self._lift()) * np.sin(angles) + x * np.cos(angles)
        diagonal[:-1] += joints
        diagonal[1:] += joints
        hessian = np.diag(diagonal) - np.diag(joints, 1) - np.diag(joints, -1)
        closing = self._closing(angles)[:, free]
        corner = np.zeros((len(forces), len(forces)))
        return np.block([[hessian[np.ix_(free, free)], -closing.T], [closing, corner]])


def solve_chain(
    shape: Elastica, segments: int, stiffness: float, weight: float, start: End, end: End
) -> DiscreteChain:
    """Find the chain next to an elastica that hangs between grips at its ends."""
    ends = {0: start, segments - 1: end}
    problem = ChainProblem(
        shape.length / (segments - 1),
        stiffness,
        weight,
        grips=list(ends),
        places=shape.positions([0.0, shape.length]),
        clamped={i: held.angle for i, held in ends.items() if isinstance(held, Clamped)},
    )
    return problem.solve(shape.angles(np.linspace(0.0, shape.length, segments)))
