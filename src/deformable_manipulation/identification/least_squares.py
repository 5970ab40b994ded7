"""Robust least squares: Levenberg-Marquardt with Huber's weights, and the deviations of the result.

P. J. Huber: Robust Statistics, 1981. The deviations allow for residuals that go together within a
window (a sandwich estimate clustered by window): neighbouring points and times are far from being
independent.
"""

from dataclasses import dataclass
from typing import List

import numpy as np

from deformable_manipulation.identification.problem import Problem

_HUBER = 2.0  # standard deviations, beyond which a residual counts with its size, not its square
_DAMPING = 1e-2  # of the first step
_MOST_TRIES = 4  # per iteration
_STEP_AT_END = 0.3  # of the steps that derivatives are taken with


@dataclass(frozen=True)
class Fit:
    """A result.

    Attributes:
        vector: (P,) parameters.
        deviations: (P,) standard deviations; NaN where there are too few windows to tell.
        converged: whether the last step was small.
    """

    vector: np.ndarray
    deviations: np.ndarray
    converged: bool


def fit(problem: Problem, start: np.ndarray, iterations: int) -> Fit:
    """Minimise the residuals of a problem.

    Args:
        start: (P,) near the minimum.
        iterations: at most.
    """
    parameters = problem.parameters
    vector, residuals = np.array(start), problem.residuals(start)
    scale = 1.4826 * np.median(np.abs(np.concatenate(residuals)))
    damping, converged = _DAMPING, False
    for _ in range(iterations):
        derivatives = _derivatives(problem, vector, residuals)
        before = _cost(residuals, scale)
        normal, gradient = _normal_equations(derivatives, residuals, scale)
        accepted = False
        for _ in range(_MOST_TRIES):
            damped = normal + damping * np.diag(np.diag(normal)) + 1e-12 * np.eye(len(vector))
            trial = parameters.bounded(vector - np.linalg.solve(damped, gradient))
            tried = problem.residuals(trial)
            if _cost(tried, scale) < before:
                accepted = True
                break
            damping *= 10.0
        moved = trial - vector
        if accepted:
            vector, residuals, damping = trial, tried, damping / 10.0
        converged = bool((np.abs(moved) < _STEP_AT_END * parameters.steps).all())
        if converged or not accepted:
            break
    return Fit(vector, _deviations(problem, vector, residuals, scale), converged)


def _derivatives(problem: Problem, vector, residuals) -> List[np.ndarray]:
    """Of each window's residuals by each parameter, (R, P)."""
    columns = []
    for number, step in enumerate(problem.parameters.steps):
        moved = np.array(vector)
        moved[number] += step
        columns.append([(a - b) / step for a, b in zip(problem.residuals(moved), residuals)])
    return [np.stack(window, axis=1) for window in zip(*columns)]


def _weights(residuals: np.ndarray, scale: float) -> np.ndarray:
    return np.minimum(1.0, _HUBER * scale / np.maximum(np.abs(residuals), 1e-300))


def _cost(residuals: List[np.ndarray], scale: float) -> float:
    size, limit = np.abs(np.concatenate(residuals)), _HUBER * scale
    return float(np.where(size < limit, size**2, 2.0 * limit * size - limit**2).sum())


def _normal_equations(derivatives, residuals, scale):
    normal, gradient = 0.0, 0.0
    for d, r in zip(derivatives, residuals):
        weighted = d * _weights(r, scale)[:, None]
        normal = normal + weighted.T @ d
        gradient = gradient + weighted.T @ r
    return normal, gradient


def _deviations(problem: Problem, vector, residuals, scale) -> np.ndarray:
    windows, count = len(residuals), len(vector)
    if windows <= count:
        return np.full(count, np.nan)  # they cannot show how much the parameters scatter
    derivatives = _derivatives(problem, vector, residuals)
    normal, _ = _normal_equations(derivatives, residuals, scale)
    inverse = np.linalg.pinv(normal, rcond=1e-12)
    scatter = np.zeros((count, count))
    for d, r in zip(derivatives, residuals):
        pull = d.T @ (_weights(r, scale) * r)
        scatter += np.outer(pull, pull)
    # The fit follows the windows by as many degrees of freedom as it has parameters.
    return np.sqrt(np.diag(inverse @ scatter @ inverse) * windows / (windows - count))
