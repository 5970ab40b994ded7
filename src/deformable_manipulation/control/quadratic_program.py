"""Solvers of small strictly convex quadratic programs, by name.

A solver is called with P (n, n), q (n,), A (m, n), b (m,) and returns the x (n,) that minimises
1/2 x' P x + q' x subject to A x >= b, or None where it found none. It does not check its input.
"""

from functools import partial

import numpy as np
import qpsolvers

# Different for each constraint, far below the safety filter's tolerance.
_LOOSENED = 1e-11 * (1.0 + np.modf(0.618033988749895 * np.arange(4096))[0])


def find_solver(name):
    """The solver called ``name`` in qpsolvers.

    quadprog is called directly: going through qpsolvers takes twice as long for a problem of
    three variables. Every other solver goes through qpsolvers.

    Raises:
        ValueError: no such solver is installed; the message names those that are.
    """
    if name not in qpsolvers.dense_solvers:
        raise ValueError(
            f"controller.solver: '{name}', allowed are the installed dense solvers of qpsolvers: "
            f"{', '.join(sorted(qpsolvers.dense_solvers))}; install it or choose one of them"
        )
    if name == "quadprog":
        from quadprog import solve_qp  # optional: it need not be there for another solver

        return partial(_solve_with_quadprog, solve_qp)
    return partial(solve_with_qpsolvers, name)


def _solve_with_quadprog(solve_qp, P, q, A, b):
    """Solve with quadprog's dual active-set method (Goldfarb and Idnani, 1983).

    It has no limit of its iterations and can go round for ever where several constraints meet in
    one point; loosening each by another minute amount keeps them from doing so.
    """
    try:
        return solve_qp(P, -q, A.T, b - _LOOSENED[: len(b)], 0)[0]
    except ValueError:  # constraints are inconsistent, or P is not positive definite
        return None


def solve_with_qpsolvers(name, P, q, A, b):
    """Solve with the solver of qpsolvers called ``name``."""
    try:
        return qpsolvers.solve_qp(P, q, -A, -b, solver=name)
    except (qpsolvers.QPError, ValueError):
        return None
