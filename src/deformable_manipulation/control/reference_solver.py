"""Solvers of qpsolvers in place of the native one: references for tests and comparisons.

A solver is called with P (n, n), q (n,), A (m, n), b (m,) and returns the x (n,) that minimises
1/2 x' P x + q' x subject to A x >= b, or None if it found none. The safety filter checks what
it returns.
"""

from functools import partial

import numpy as np

# Different for each constraint, far below the safety filter's tolerance.
_LOOSENED = 1e-11 * (1.0 + np.modf(0.618033988749895 * np.arange(4096))[0])


def find_solver(name):
    """The solver called ``name``: of qpsolvers, or None for ``native``.

    quadprog is called directly: going through qpsolvers takes twice as long for a problem of
    three variables. Every other solver goes through qpsolvers.

    Raises:
        ValueError: no such solver is installed; the message names those that are.
    """
    if name == "native":
        return None
    import qpsolvers  # slow to import, and not needed for the native solver

    if name not in qpsolvers.dense_solvers:
        raise ValueError(
            f"controller.solver: '{name}' must be native or one of the installed dense solvers of "
            f"qpsolvers: {', '.join(sorted(qpsolvers.dense_solvers))}; install it or choose one"
        )
    if name == "quadprog":
        from quadprog import solve_qp  # optional: another solver does not need it

        return partial(_solve_with_quadprog, solve_qp)
    return partial(_solve_with_qpsolvers, qpsolvers, name)


def _solve_with_quadprog(solve_qp, P, q, A, b):
    """Solve with quadprog's dual active-set method (Goldfarb and Idnani, 1983).

    It has no limit on its iterations and can loop forever if several constraints meet in one
    point. Loosening each by a different tiny amount prevents that.
    """
    try:
        return solve_qp(P, -q, A.T, b - _LOOSENED[: len(b)], 0)[0]
    except ValueError:  # constraints are inconsistent, or P is not positive definite
        return None


def _solve_with_qpsolvers(qpsolvers, name, P, q, A, b):
    try:
        return qpsolvers.solve_qp(P, q, -A, -b, solver=name)
    except (qpsolvers.QPError, ValueError):
        return None
