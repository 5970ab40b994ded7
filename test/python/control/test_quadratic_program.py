"""The native solver of quadratic programs, by the conditions of optimality and beside quadprog."""

import numpy as np
import pytest
from quadprog import solve_qp as solve_with_quadprog
from scipy.optimize import linprog, nnls

from deformable_manipulation._control import solve_qp

SIZES = (1, 3, 7, 13)  # variables: one to three assistants with their slacks
GRID = np.array([0.0, 0.0, 1.0, -1.0, 0.5, 2.0, -2.0, 1e-3])


def random_rows(generator, n):
    """Rows in general position, most of them satisfiable."""
    A = generator.normal(size=(generator.integers(5, 101), n))
    return A, 0.3 * generator.normal(size=len(A)) - generator.choice([0.0, 1.0, 2.0])


def rows_on_a_grid(generator, n):
    """Equal, opposite, empty rows, and many that meet in one point."""
    A = generator.choice(GRID, size=(generator.integers(5, 101), n))
    return A, generator.choice(GRID, size=len(A)) - generator.choice([0.0, 1.0])


def nearly_parallel_rows(generator, n):
    base = generator.normal(size=(3, n))
    A = base[generator.integers(3, size=40)]
    A = A + generator.choice([0.0, 1e-12, 1e-9, 1e-6, 1e-4]) * generator.normal(size=A.shape)
    gaps = generator.choice([0.0, 1e-9, 1e-3, 0.1]) * generator.exponential(size=len(A))
    return A, A @ generator.normal(size=n) - gaps


def rows_through_one_point(generator, n):
    A = generator.normal(size=(generator.integers(5, 101), n))
    return A, A @ generator.normal(size=n) - generator.choice([0.0, 1e-12, 0.1], size=len(A))


KINDS = [random_rows, rows_on_a_grid, nearly_parallel_rows, rows_through_one_point]


def random_cost(generator, n):
    spread = generator.choice([0.0, 1.0])
    hessian = 10.0 ** (spread * generator.uniform(-2.0, 2.0, n))
    return hessian, generator.normal(size=n) * 10.0 ** generator.uniform(-3.0, 3.0)


def residual_of_optimality(hessian, linear, A, b, x):
    """How far the cost's slope is from a positive combination of the active rows', relative."""
    root = np.sqrt(hessian)
    normals = A / root
    lengths = np.maximum(np.linalg.norm(normals, axis=1), 1e-300)
    margins = (A @ x - b) / lengths
    tolerance = 1e-8 * (1.0 + np.abs(x * root).max())
    assert margins.min(initial=0.0) >= -tolerance
    active = margins < 10.0 * tolerance
    slope = (hessian * x + linear) / root
    combination = (normals[active] / lengths[active, None]).T
    missing = nnls(combination, slope)[1] if active.any() else np.linalg.norm(slope)
    return missing / (1.0 + np.linalg.norm(linear / root))


def least_violation(A, b):
    """Of the worst row, in units of its length; inf for an empty row that asks for something."""
    lengths = np.linalg.norm(A, axis=1)
    if (b[lengths == 0.0] > 0.0).any():
        return np.inf
    A, b = (
        part[lengths > 0.0] / lengths[lengths > 0.0, None].reshape(-1, *[1] * (part.ndim - 1))
        for part in (A, b)
    )
    bounds = [(None, None)] * A.shape[1] + [(0.0, None)]
    cost = np.append(np.zeros(A.shape[1]), 1.0)
    return linprog(cost, A_ub=-np.column_stack((A, np.ones(len(b)))), b_ub=-b, bounds=bounds).fun


@pytest.mark.parametrize("make_rows", KINDS)
@pytest.mark.parametrize("n", SIZES)
def test_solutions_are_optimal_and_only_contradictions_have_none(make_rows, n):
    generator = np.random.default_rng([n, KINDS.index(make_rows)])
    solved = 0
    for _ in range(40):
        A, b = make_rows(generator, n)
        hessian, linear = random_cost(generator, n)
        x = solve_qp(hessian, linear, A, b)
        if x is None:
            assert least_violation(A, b) > 1e-7
        else:
            assert residual_of_optimality(hessian, linear, A, b, x) < 1e-7
            solved += 1
    assert solved > 0


@pytest.mark.parametrize("n", SIZES)
def test_agrees_with_quadprog(n):
    generator = np.random.default_rng(n)
    for _ in range(40):
        A, b = random_rows(generator, n)
        b -= 1.0
        hessian, linear = random_cost(generator, n)
        x = solve_qp(hessian, linear, A, b)
        try:
            reference = solve_with_quadprog(np.diag(hessian), -linear, A.T, b)[0]
        except ValueError:
            assert x is None
        else:
            np.testing.assert_allclose(x, reference, atol=1e-8 * (1.0 + np.abs(reference).max()))


def test_without_constraints_it_is_the_minimum_of_the_cost():
    x = solve_qp([1.0, 4.0], [-1.0, 2.0], np.empty((0, 2)), np.empty(0))
    np.testing.assert_array_equal(x, [1.0, -0.5])


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("place", range(3))
def test_what_is_not_finite_has_no_solution(place, value):
    program = [np.zeros(2), np.eye(2), np.zeros(2)]
    program[place].flat[0] = value
    assert solve_qp(np.ones(2), *program) is None


def test_shapes_and_costs_that_do_not_fit_are_refused():
    for hessian, linear, A, b in [
        (np.ones(2), np.ones(3), np.eye(2), np.ones(2)),
        (np.ones(2), np.ones(2), np.eye(3), np.ones(3)),
        (np.ones(2), np.ones(2), np.eye(2), np.ones(3)),
        (np.zeros(2), np.ones(2), np.eye(2), np.ones(2)),
    ]:
        with pytest.raises(ValueError, match="expected hessian"):
            solve_qp(hessian, linear, A, b)
