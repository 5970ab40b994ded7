"""The programs that the solvers are timed on."""

import numpy as np
import pytest

from deformable_manipulation._control import SafetyFilter
from deformable_manipulation.benchmarks.qp_problems import (
    FEASIBLE,
    INFEASIBLE,
    KINDS,
    MAX_VELOCITY,
    make_problems,
)
from deformable_manipulation.control.reference_solver import find_solver
from deformable_manipulation.control.status import Status

ROWS = (3, 5, 30)
COUNT = 50


def solve(program):
    solver = find_solver("quadprog")
    return solver(program.hessian, program.linear, program.constraints, program.limits)


def filtered(problem):
    """Velocity and status."""
    result = SafetyFilter(np.ones(3), KINDS).filter(
        problem.nominal, problem.rows(), problem.lower, problem.upper
    )
    return result[0], Status(result[1])


@pytest.mark.parametrize("rows", ROWS)
def test_filter_and_solver_agree_on_feasible_problems(rows):
    statuses = []
    for problem in make_problems(FEASIBLE, rows, COUNT):
        velocity, status = filtered(problem)
        statuses.append(status)
        assert len(problem.rows()) == rows
        np.testing.assert_allclose(velocity, solve(problem.hard()), atol=1e-6)
        np.testing.assert_allclose(velocity, solve(problem.soft())[:3], atol=1e-5)
    # Nearly always the rows hinder: where the nominal velocity will do, no program is solved.
    assert statuses.count(Status.CONSTRAINED) > 0.9 * COUNT


@pytest.mark.parametrize("rows", ROWS)
def test_infeasible_problems_have_a_relaxed_solution_only(rows):
    for problem in make_problems(INFEASIBLE, rows, COUNT):
        assert solve(problem.hard()) is None
        soft = solve(problem.soft())
        assert np.abs(soft[:3]).max() <= MAX_VELOCITY + 1e-9 and soft[3:].max() > 1e-3
        assert filtered(problem)[1] is Status.RELAXED


def test_the_problems_are_the_same_in_every_run():
    first, second = (make_problems(FEASIBLE, 7, 2) for _ in range(2))
    for one, other in zip(first, second):
        np.testing.assert_array_equal(one.hard().constraints, other.hard().constraints)
    assert np.abs(first[0].nominal - first[1].nominal).max() > 1e-3


def test_too_few_rows_are_refused():
    with pytest.raises(ValueError, match="3 or more"):
        make_problems(FEASIBLE, 2, 1)
