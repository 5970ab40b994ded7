"""Identification: a grid, then least squares; what the data do not tell; cross-validation."""

import dataclasses
import itertools
import math
from dataclasses import dataclass
from typing import Callable, Dict, List, Optional, Sequence

import numpy as np

from deformable_manipulation.identification.least_squares import Fit, fit
from deformable_manipulation.identification.material_parameters import MaterialParameters
from deformable_manipulation.identification.parameters import Parameters
from deformable_manipulation.identification.problem import Problem, Window

_FACTORS = np.geomspace(1 / 30.0, 30.0, 7)
_GRID = {
    "young_modulus": _FACTORS,  # times what was given
    "bending_compliance": _FACTORS,  # likewise
    "bending_retardation_time": np.array((0.01, 0.05, 0.2)),  # s
}
_OF_GIVEN = ("young_modulus", "bending_compliance")
_GRID_WINDOWS = 6
_ITERATIONS = 8
_REFINEMENTS = 2  # iterations of a fold, from the result of all
_TORSION_FACTOR = 3.0


@dataclass(frozen=True)
class Identification:
    """A result.

    Attributes:
        parameters: what was fitted.
        fit: the vector and its deviations.
        errors: mean over the windows of the numbers of :class:`.Difference` [m].
        torsion: relative change of the mean distance with a third and three times the torsion
            modulus; None of fabrics.
        left_out: mean per coordinate [m] of recordings that were left out of the fit, and of those
            in it; None without cross-validation.
        straight: relative change of the mean distance if all else is fitted without the natural
            curvature; None if that was not fitted.
    """

    parameters: MaterialParameters
    fit: Fit
    errors: Dict[str, float]
    torsion: Optional[Sequence[float]]
    left_out: Optional[Sequence[float]]
    straight: Optional[float] = None


def identify(
    parameters: MaterialParameters,
    windows: Sequence[Window],
    folds: int,
    progress: Callable[[float], None] = lambda fraction: None,
    each: Callable = map,
) -> Identification:
    """Fit parameters to windows of recordings.

    Args:
        folds: into which recordings are divided for cross-validation; 0: none.
        progress: is called with the fraction done.
        each: like ``map``, for the windows: see :func:`.worker_map`.
    """
    count = _Counter(progress, _planned(parameters, windows, folds))
    problem = Problem(parameters, windows, count, each)
    start = _best_of_grid(problem)
    count.advance_to(0.25)
    result = fit(problem, start, _ITERATIONS)
    count.advance_to(0.7)
    errors = _mean(problem.mean_errors(result.vector))
    torsion = straight = None
    if isinstance(parameters, Parameters):
        torsion = _torsion_matters(problem, parameters, result.vector)
        if parameters.curved:
            straight = _curvature_matters(problem, parameters, result.vector)
    left_out = _cross_validate(problem, result.vector, folds) if folds > 1 else None
    progress(1.0)
    return Identification(parameters, result, errors, torsion, left_out, straight)


class _Counter:
    """Counts evaluations for the progress bar."""

    def __init__(self, progress, planned: int):
        self._progress, self._planned, self._done, self._least = progress, planned, 0, 0.0

    def __call__(self) -> None:
        self._done += 1
        self._progress(min(0.99, max(self._least, self._done / self._planned)))

    def advance_to(self, fraction: float) -> None:
        self._least = fraction


def _planned(parameters: MaterialParameters, windows, folds: int) -> int:
    per_iteration = len(parameters.names) + 2
    return 25 + _ITERATIONS * per_iteration + folds * (_REFINEMENTS + 1) * per_iteration


def _best_of_grid(problem: Problem) -> np.ndarray:
    """The best vector of a coarse grid: from afar, least squares get stuck."""
    parameters = problem.parameters
    few = problem.subset(_spread(problem.windows, _GRID_WINDOWS))
    start = best = parameters.start()
    least = math.inf
    keys = [key for key in parameters.material if key in _GRID]
    for values in itertools.product(*(_GRID[key] for key in keys)):
        vector = start
        for key, value in zip(keys, values):
            given = math.exp(start[parameters.material.index(key)]) if key in _OF_GIVEN else 1.0
            vector = parameters.with_value(vector, key, given * value)
        cost = np.mean(np.abs(np.concatenate(few.residuals(parameters.bounded(vector)))))
        if cost < least:
            best, least = parameters.bounded(vector), cost
    return best


def _spread(windows: List[Window], count: int) -> List[Window]:
    """Some windows from all over."""
    return [windows[i] for i in np.unique(np.linspace(0, len(windows) - 1, count).astype(int))]


def _mean(numbers: Sequence[Dict[str, float]]) -> Dict[str, float]:
    """Over windows; of the worst, the worst."""
    found = {}
    for name in numbers[0]:
        values = np.array([each.get(name, np.inf) for each in numbers])
        values = values[~np.isnan(values)]
        if values.size:
            found[name] = float(values.max() if name.startswith("worst") else values.mean())
        else:
            found[name] = math.nan
    return found


def _torsion_matters(problem: Problem, parameters: Parameters, vector: np.ndarray) -> List[float]:
    """Relative change of the mean distance in some windows."""
    spec = parameters.spec
    few = problem.subset(_spread(problem.windows, _GRID_WINDOWS))
    distances = []
    for factor in (1.0, 1.0 / _TORSION_FACTOR, _TORSION_FACTOR):
        other = dataclasses.replace(spec, torsion_modulus=factor * spec.torsion_modulus)
        few.parameters = dataclasses.replace(parameters, spec=other)
        distances.append(_mean(few.mean_errors(vector))["mean_distance"])
    return [distance / distances[0] - 1.0 for distance in distances[1:]]


def _curvature_matters(problem: Problem, parameters: Parameters, vector: np.ndarray) -> float:
    """Relative change of the mean distance without the natural curvature, all else fitted anew."""
    curved = _mean(problem.mean_errors(vector))["mean_distance"]
    straight = problem.subset(problem.windows)
    straight.parameters, others = parameters.straight(vector)
    if others.size:
        others = fit(straight, others, _ITERATIONS).vector
    return _mean(straight.mean_errors(others))["mean_distance"] / curved - 1.0


def _cross_validate(problem: Problem, vector: np.ndarray, folds: int) -> Sequence[float]:
    left_out, inside = [], []
    for fold in range(folds):
        test = [w for w in problem.windows if w.recording % folds == fold]
        train = [w for w in problem.windows if w.recording % folds != fold]
        found = fit(problem.subset(train), vector, _REFINEMENTS).vector
        for windows, errors in ((test, left_out), (train, inside)):
            means = problem.subset(windows).mean_errors(found)
            errors += [each["mean_per_coordinate"] for each in means]
    return float(np.mean(left_out)), float(np.mean(inside))
