"""The subject ``qp``: the safety filter and its solver, beside others on the same programs."""

from typing import Callable, List, Tuple

import numpy as np
import qpsolvers
import quadprog

from deformable_manipulation._control import SafetyFilter, solve_qp
from deformable_manipulation.benchmarks.harness import measure_each
from deformable_manipulation.benchmarks.qp_problems import (
    FEASIBLE,
    INFEASIBLE,
    KINDS,
    Program,
    make_problems,
)
from deformable_manipulation.benchmarks.subject import Request
from deformable_manipulation.benchmarks.table import Column, Table
from deformable_manipulation.control.reference_solver import find_solver
from deformable_manipulation.control.status import Status

try:
    import daqp
except ImportError:  # not needed, only compared with
    daqp = None

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
    "safety filter: from rows and bounds at hand to a checked velocity, always with the relaxed "
    "program; with quadprog: the same program by that solver",
    "native, quadprog, qpsolvers (with quadprog), daqp: from matrices at hand to a solution, "
    "unchecked; hard: three variables, rows as they are; soft: six variables, one slack per kind "
    "of constraint",
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
    native = SafetyFilter(np.ones(3), KINDS)
    reference = SafetyFilter(np.ones(3), KINDS, solver=find_solver("quadprog"))
    candidates = [
        ("safety filter", [_filtering(native, problem) for problem in problems]),
        ("safety filter with quadprog", [_filtering(reference, problem) for problem in problems]),
    ]
    solvers = [
        ("native", _with_native),
        ("quadprog", _with_quadprog),
        ("qpsolvers", _with_qpsolvers),
    ]
    if daqp is not None:
        solvers.append(("daqp", _with_daqp))
    for name, solve in solvers:
        for form, programs in (
            ("hard", [problem.hard() for problem in problems]),
            ("soft", [problem.soft() for problem in problems]),
        ):
            candidates.append((f"{name}, {form}", [_solving(solve, each) for each in programs]))
    return candidates


def _filtering(safety_filter: SafetyFilter, problem) -> Call:
    rows = problem.rows()
    given = (problem.nominal, rows, problem.lower, problem.upper)
    return lambda: safety_filter.filter(*given)[1] != Status.FAILED


def _solving(solve: Callable[[Program], bool], program: Program) -> Call:
    return lambda: solve(program)


def _with_native(program: Program) -> bool:
    solution = solve_qp(
        program.hessian.diagonal(), program.linear, program.constraints, program.limits
    )
    return solution is not None


def _with_daqp(program: Program) -> bool:
    beyond = np.full(len(program.limits), 1e30)
    kinds = np.zeros(len(program.limits), dtype=np.int32)
    solution = daqp.solve(
        program.hessian, program.linear, program.constraints, beyond, program.limits, kinds
    )
    return solution[2] > 0


def _with_quadprog(program: Program) -> bool:
    try:
        quadprog.solve_qp(program.hessian, -program.linear, program.constraints.T, program.limits)
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
