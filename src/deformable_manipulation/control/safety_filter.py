"""The velocity nearest to the nominal one that the constraints allow."""

import math
import time
from dataclasses import dataclass

import numpy as np

from deformable_manipulation.control.barriers import Tier
from deformable_manipulation.control.quadratic_program import find_solver
from deformable_manipulation.control.status import Status

TOLERANCE = 1e-6  # m/s, by which a constraint may be missed before it counts as relaxed

# A row whose coefficients sum to less than this asks for more than the agent can give: at
# 0.15 m/s it changes its barrier by less than 0.15 mm/s, about what differences between copies
# resolve. It is left out of the program and shows in the slack alone.
_NEGLIGIBLE_GRADIENT = 1e-3

# Cost of one m/s of slack per tier, in multiples of the steepest cost of departing from the
# nominal velocity.
_PENALTIES = np.array([1e6, 1e4, 1e2])


@dataclass(frozen=True)
class Filtered:
    """Result of the safety filter."""

    velocity: np.ndarray  # (3,) m/s, always finite and within the bounds, or zero if FAILED
    status: Status  # NOMINAL, CONSTRAINED, RELAXED or FAILED
    slack: np.ndarray  # (3,) m/s, by how much the rows of each Tier are missed at most
    rows: int
    solve_time: float  # s


class SafetyFilter:
    """min 1/2 |diag(weights) (u - nominal)|^2 subject to rows and bounds (paper, eq. 13).

    The bounds always hold. If the rows cannot all hold, they are relaxed with one slack per tier:

        min 1/2 |diag(weights) (u - nominal)|^2 + sum_t (c_t s_t + r s_t^2 / 2),  s_t >= 0,
        rows of tier t: g . u >= min(b, most that g . u reaches within the bounds) - s_t.

    The linear penalty makes a slack exactly zero wherever its tier can hold; the quadratic one,
    r = max(weights)^2, only makes the cost positive definite. The costs c_t are a factor of 100
    apart rather than strictly lexicographic: a strict order would spend all of a lower tier on a
    gain of a micrometre per second in a higher one, which a row of nearly no gradient asks for.
    So a tier yields to a lower one only where it would cost that one more than a hundredfold.
    Taking the minimum keeps a row that no velocity can satisfy from loosening the others of its
    tier; what it lacks shows in the reported slack.

    Args:
        weights: gamma (3,), positive.
        solver: name of a solver of qpsolvers.

    Raises:
        ValueError: a weight is not positive, or the solver is not installed.
    """

    def __init__(self, weights, solver="quadprog"):
        gamma = np.asarray(weights, dtype=float)
        if gamma.shape != (3,) or not (np.isfinite(gamma).all() and (gamma > 0.0).all()):
            raise ValueError(f"controller.weights: {weights}, allowed are three positive numbers")
        self._squares = (gamma / gamma.max()) ** 2  # only their ratios matter
        self._hessian = np.diag(self._squares)
        self._relaxed_hessian = np.diag(np.append(self._squares, np.full(3, self._squares.max())))
        self._solve = find_solver(solver)
        self._templates = {}

    def filter(self, nominal, rows, lower, upper):
        """Filter one nominal velocity.

        Args:
            nominal: (3,) m/s.
            rows: sequence of :class:`~.barriers.Rows`, any number of each tier.
            lower, upper: (3,) m/s, bounds of the velocity.

        Returns:
            :class:`Filtered`; FAILED with zero velocity if a number is not finite, the bounds
            are crossed, or the solver gives no valid solution.
        """
        started = time.perf_counter()
        problem = _Problem(nominal, rows, lower, upper)
        velocity, slack = self._solution(problem)
        status = _status(velocity, nominal, slack)
        if velocity is None:
            velocity = np.zeros(3)
        return Filtered(velocity, status, slack, problem.count, time.perf_counter() - started)

    def _solution(self, problem):
        """Velocity and slack; no velocity if there is none that is valid."""
        # With a diagonal cost, clipping is the optimum over the bounds alone, and so the optimum
        # altogether if it satisfies the rows.
        clipped = problem.clip(problem.nominal)
        margins = _margins(problem.constraints, clipped, problem.limits)
        # A sum is finite only if all terms are: solvers may ignore a row with NaN in silence.
        if not (math.isfinite(sum(margins)) and math.isfinite(sum(problem.nominal.tolist()))):
            return None, np.zeros(len(Tier))
        if min(margins) >= 0.0:
            return clipped, np.zeros(len(Tier))
        velocity = self._constrained(problem)
        if velocity is not None:
            return velocity, np.zeros(len(Tier))
        velocity = self._relaxed(problem)
        return velocity, np.zeros(len(Tier)) if velocity is None else problem.slack(velocity)

    def _constrained(self, problem):
        """The velocity that satisfies all rows, or None."""
        linear = -self._squares * problem.nominal
        solution = self._solve(self._hessian, linear, problem.constraints, problem.limits)
        return problem.checked(solution, problem.constraints, problem.limits)

    def _relaxed(self, problem):
        """The velocity that misses the rows as little as possible in their priority, or None."""
        linear = -self._squares * problem.nominal
        bound = np.maximum(-problem.lower, problem.upper)
        steepest = max((np.abs(linear) + self._squares * bound).tolist()) or 1.0
        linear = np.concatenate((linear, steepest * _PENALTIES))
        constraints = self._template(problem.tiers).copy()
        constraints[: len(problem.limits), :3] = problem.constraints
        limits = np.concatenate((problem.reachable(), problem.limits[problem.count :], _NO_SLACK))
        solution = self._solve(self._relaxed_hessian, linear, constraints, limits)
        return problem.checked(solution, constraints, limits)

    def _template(self, tiers):
        """Constraints of the relaxed program as far as the numbers of rows tell."""
        template = self._templates.get(tiers)
        if template is None:
            owners = [int(tier) for tier, count in tiers for _ in range(count)]
            template = np.zeros((len(owners) + 9, 6))
            template[np.arange(len(owners)), [3 + owner for owner in owners]] = 1.0
            template[-3:, 3:] = np.eye(3)
            self._templates[tiers] = template
        return template


_BOUND_ROWS = np.concatenate((np.eye(3), -np.eye(3)))
_NO_SLACK = np.zeros(len(Tier))


class _Problem:
    """The rows of all tiers, then the bounds: ``constraints @ u >= limits``."""

    def __init__(self, nominal, rows, lower, upper):
        self.nominal, self.lower, self.upper = nominal, lower, upper
        self.tiers = tuple([(part.tier, len(part.bounds)) for part in rows])
        self.constraints = np.concatenate([part.coefficients for part in rows] + [_BOUND_ROWS])
        self.limits = np.concatenate([part.bounds for part in rows] + [lower, -upper])
        self.count = len(self.limits) - len(_BOUND_ROWS)  # rows of the barriers

    def clip(self, velocity):
        """The nearest velocity within the bounds."""
        return np.minimum(np.maximum(velocity, self.lower), self.upper)

    def reachable(self):
        """The limits of the barriers' rows without what this agent cannot reach anyway."""
        A = self.constraints[: self.count]
        reach = np.maximum(A * self.lower, A * self.upper) @ _ONES
        effective = np.abs(A) @ _ONES >= _NEGLIGIBLE_GRADIENT
        # A limit of -1 m/s is satisfied by every velocity of such a row.
        return np.where(effective, np.minimum(self.limits[: self.count], reach), -1.0)

    def checked(self, solution, constraints, limits):
        """The velocity of a solution, rounding at the bounds taken off; None if it is not valid."""
        if solution is None:
            return None
        margins = _margins(constraints, solution, limits)
        if not (math.isfinite(sum(margins)) and min(margins) >= -TOLERANCE):
            return None
        return self.clip(solution[:3])

    def slack(self, velocity):
        """Largest amount (3,) [m/s] that the rows of each tier are missed by, or 0."""
        margins = _margins(self.constraints, velocity, self.limits)
        slack, start = [0.0] * len(Tier), 0
        for tier, count in self.tiers:
            missing = -min(margins[start : start + count], default=0.0)
            if missing > TOLERANCE:
                slack[tier] = max(slack[tier], missing)
            start += count
        return np.array(slack)


_ONES = np.ones(3)


def _margins(constraints, x, limits):
    """By how much each constraint holds, as a list: faster than numpy for so few numbers."""
    return (constraints @ x - limits).tolist()


def _status(velocity, nominal, slack):
    if velocity is None:
        return Status.FAILED
    if any(slack.tolist()):
        return Status.RELAXED
    if max(map(abs, (velocity - nominal).tolist())) > TOLERANCE:
        return Status.CONSTRAINED
    return Status.NOMINAL
