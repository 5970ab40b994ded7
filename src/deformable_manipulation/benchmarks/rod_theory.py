"""How far a rod at rest is from theory."""

import numpy as np

from deformable_manipulation.benchmarks.rod_case import ROPE, RodCase
from deformable_manipulation.benchmarks.trial import Trial
from deformable_manipulation.validation.references.elastica import (
    Pinned,
    solve_between,
    solve_cantilever,
)


def error_of(trial: Trial, case: RodCase) -> float:
    """Relative error [1] of the shape at rest, against the inextensible elastica.

    Rope: the largest deviation of a point over the length. Cantilever: that of the last point's
    drop over the drop.
    """
    points, arcs = np.array(trial.points), np.array(trial.measures["arc_lengths"])
    free_length = trial.measures["free_length"]
    stiffness, weight = case.bending_stiffness, case.weight_per_length
    if case.load == ROPE:
        grip = Pinned(trial.measures["overhang"])
        theory = solve_between(free_length, stiffness, weight, (case.span, 0.0), grip, grip)
        deviations = np.linalg.norm(points - theory.positions(arcs), axis=1)
        return float(deviations.max()) / case.length
    theory = solve_cantilever(free_length, stiffness, weight)
    drop = theory.positions(arcs[-1:])[0, 1]
    return float(points[-1, 1] / drop - 1.0)
