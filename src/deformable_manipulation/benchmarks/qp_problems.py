"""Random programs of the kind that an assistant solves every cycle; the same in every run."""

from dataclasses import dataclass
from typing import List, Sequence

import numpy as np

from deformable_manipulation._control import ConstraintRows

FEASIBLE = "feasible"
INFEASIBLE = "infeasible"
SEED = 20  # any
MAX_VELOCITY = 0.15  # m/s
KINDS = (0, 1, 2)  # of limits: collision, overstretch, proximity
SLACK_COSTS = (1e6, 1e4, 1e2)  # times the cost of u_max, per kind


@dataclass(frozen=True)
class Program:
    """min 1/2 x' hessian x + linear' x, constraints x >= limits."""

    hessian: np.ndarray
    linear: np.ndarray
    constraints: np.ndarray
    limits: np.ndarray


@dataclass(frozen=True)
class Problem:
    """What a safety filter with equal weights is given."""

    nominal: np.ndarray
    kinds: Sequence[int]  # of each row, its place in KINDS
    coefficients: np.ndarray
    limits: np.ndarray
    lower: np.ndarray
    upper: np.ndarray

    def rows(self) -> ConstraintRows:
        """The rows as the safety filter takes them."""
        rows = ConstraintRows(len(self.nominal))
        for kind, coefficients, limit in zip(self.kinds, self.coefficients, self.limits):
            rows.add(kind, coefficients, limit)
        return rows

    def hard(self) -> Program:
        """All rows and bounds as they are."""
        bounds = np.concatenate([np.eye(3), -np.eye(3)])
        return Program(
            np.eye(3),
            -self.nominal,
            np.concatenate([self.coefficients, bounds]),
            np.concatenate([self.limits, self.lower, -self.upper]),
        )

    def soft(self) -> Program:
        """Rows that may be missed by a slack per kind, at a linear cost."""
        hard = self.hard()
        slack = np.zeros((len(hard.limits), len(KINDS)))
        slack[np.arange(len(self.kinds)), self.kinds] = 1.0
        positive = np.hstack([np.zeros((len(KINDS), 3)), np.eye(len(KINDS))])
        return Program(
            np.eye(3 + len(KINDS)),
            np.concatenate([hard.linear, MAX_VELOCITY * np.array(SLACK_COSTS)]),
            np.vstack([np.hstack([hard.constraints, slack]), positive]),
            np.concatenate([hard.limits, np.zeros(len(KINDS))]),
        )


def make_problems(kind: str, rows: int, count: int) -> List[Problem]:
    """A number of problems with so many rows, 3 at least; raises ValueError for fewer."""
    if rows < 3:
        raise ValueError(f"rows: {rows} must be 3 or more")
    generator = np.random.default_rng([SEED, rows])
    return [_problem(kind, rows, generator) for _ in range(count)]


def _problem(kind: str, count: int, generator: np.random.Generator) -> Problem:
    """Rows that a random velocity satisfies, most of them against the nominal velocity."""
    possible = generator.uniform(-0.5, 0.5, 3) * MAX_VELOCITY
    towards = _unit(generator.normal(size=3))
    nominal = -MAX_VELOCITY * towards
    # Rows of neighbouring segments have similar normals.
    normals = _unit(towards + 0.5 * generator.normal(size=(count, 3)))
    coefficients = generator.uniform(0.2, 1.0, (count, 1)) * normals
    bounds = coefficients @ possible - generator.exponential(0.02, count)
    if kind == INFEASIBLE:
        coefficients[1] = -coefficients[0]
        bounds[1] = -bounds[0] + 0.02
    kinds = [0] * (count - 2) + [1, 2]
    limit = np.full(3, MAX_VELOCITY)
    return Problem(nominal, kinds, coefficients, bounds, -limit, limit)


def _unit(vectors: np.ndarray) -> np.ndarray:
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)
