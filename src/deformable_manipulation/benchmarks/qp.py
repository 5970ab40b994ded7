"""The subject ``qp``: the safety filter, beside its solver directly and through qpsolvers."""

from functools import partial
from typing import Callable, List, Tuple

import numpy as np
import qpsolvers
from quadprog import solve_qp

from deformable_manipulation.benchmarks.harness import measure_each
from deformable_manipulation.benchmarks.qp_problems import (
    FEASIBLE,
    INFEASIBLE,
    Program,
    make_problems,
)
from deformable_manipulation.benchmarks.subject import Request
from deformable_manipulation.benchmarks.table import Column, Table
from deformable_manipulation.control.safety_filter import SafetyFilter
from deformable_manipulation.control.status import Status

ROWS = (5, 10, 20, 30)
PROBLEMS = 200  # different ones, for each number of rows
ROUNDS = {True: 1, False: 20}  # over all of them; quick, full

COLUMNS = (
    Column("problems", "problems"),
    Column("rows", "rows", "d"),
    Column("solver", "what is called"),
    Column("median_us", "median [µs]", ".1f"),
    Column("p99_us", "p99 [µs]", ".1f"),
    Column("minimum_us", "minimum [µs]", ".1f"),
    Column("solved", "solved [%]", ".0f"),
)
NOTES = (
    "safety filter: from rows and bounds to a checked velocity, with the relaxed program where the "
    "rows cannot all hold",
    "quadprog, qpsolvers: from matrices at hand to a solution, unchecked; hard: three variables, "
    "rows as they are; soft: six variables, one slack per tier",
    "infeasible: at least two rows contradict each other; the solvers then have no solution of the "
    "hard program",
)

Call = Callable[[], bool]  # true where there is a solution


def measure_tables(request: Request) -> List[Table]:
    """Time the filter and the solvers on the same problems."""
    table = Table("latency", "Three velocities, one thread", COLUMNS, notes=list(NOTES))
    for kind in (FEASIBLE, INFEASIBLE):
        for rows in ROWS[:1] if request.quick else ROWS:
            problems = make_problems(kind, rows, PROBLEMS)
            for name, calls in _candidates(problems):
                request.say(f"{kind}, {rows} rows, {name}")
                table.rows.append({"problems": kind, "rows": rows, **_row(name, calls, request)})
    return [table]


def _row(name: str, calls: List[Call], request: Request) -> dict:
    solved = np.mean([call() for call in calls])
    timing = measure_each(calls, ROUNDS[request.quick])
    return {
        "solver": name,
        "median_us": 1e6 * timing.median,
        "p99_us": 1e6 * timing.quantile(0.99),
        "minimum_us": 1e6 * timing.minimum,
        "solved": 100.0 * float(solved),
        "calls": len(timing.seconds),
    }


def _candidates(problems) -> List[Tuple[str, List[Call]]]:
    safety_filter = SafetyFilter(np.ones(3))
    hard = [problem.hard() for problem in problems]
    soft = [problem.soft() for problem in problems]
    return [
        ("safety filter", [partial(_filtered, safety_filter, problem) for problem in problems]),
        ("quadprog, hard", [partial(_with_quadprog, program) for program in hard]),
        ("quadprog, soft", [partial(_with_quadprog, program) for program in soft]),
        ("qpsolvers, hard", [partial(_with_qpsolvers, program) for program in hard]),
        ("qpsolvers, soft", [partial(_with_qpsolvers, program) for program in soft]),
    ]


def _filtered(safety_filter: SafetyFilter, problem) -> bool:
    result = safety_filter.filter(problem.nominal, problem.rows, problem.lower, problem.upper)
    return result.status is not Status.FAILED


def _with_quadprog(program: Program) -> bool:
    try:
        solve_qp(program.hessian, -program.linear, program.constraints.T, program.limits)
    except ValueError:  # inconsistent constraints
        return False
    return True


def _with_qpsolvers(program: Program) -> bool:
    solution = qpsolvers.solve_qp(
        program.hessian,
        program.linear,
        -program.constraints,
        -program.limits,
        solver="quadprog",
    )
    return solution is not None
