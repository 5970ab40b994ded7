"""Microseconds per substep of the rod, by segments, copies and solver."""

import numpy as np

from deformable_manipulation import _pbd
from deformable_manipulation.benchmarks.copies import COLUMNS, add_copies, time_substep
from deformable_manipulation.benchmarks.package_rod import SUBSTEP, make_rod
from deformable_manipulation.benchmarks.rod_case import ROPE, RodCase
from deformable_manipulation.benchmarks.subject import Request
from deformable_manipulation.benchmarks.table import Column, Table

SEGMENTS = (28, 45, 100, 200)
COPIES = (1, 4, 8, 13)  # the object among them
SOLVERS = ("direct", "gauss_seidel")
CALL = 20  # substeps in one call of the timed Rod.step
CARRIED = (0.0, -0.02, 0.05)  # m/s, of the last end: a rod at rest could be less work
LEAD_TIME = 2.0  # s, until the copies have arrived at their displacements

CASE_COLUMNS = (Column("solver", "solver"), Column("segments", "segments", "d"))


def substep_table(request: Request) -> Table:
    """Time every combination."""
    table = Table(
        "substep", "One substep of the rope, all copies, one thread", CASE_COLUMNS + COLUMNS
    )
    for solver in SOLVERS:
        for segments in SEGMENTS[:1] if request.quick else SEGMENTS:
            for copies in COPIES:
                request.say(f"{solver}, {segments} segments, {copies} copies")
                table.rows.append(_row(solver, segments, copies, request))
    table.notes.append(
        f"substeps of {1e3 * SUBSTEP['direct']:g} ms (direct) and "
        f"{1e3 * SUBSTEP['gauss_seidel']:g} ms (gauss_seidel), {CALL} in one call from Python"
    )
    return table


def _row(solver: str, segments: int, copies: int, request: Request) -> dict:
    rod = carried_rope(solver, segments, copies)
    timing = time_substep(rod, SUBSTEP[solver], CALL, request.effort)
    return {"solver": solver, "segments": segments, **timing}


def carried_rope(solver: str, segments: int, copies: int) -> _pbd.Rod:
    """The paper's rope, clamped at both ends 1.5 m apart, in motion, its copies displaced."""
    case = RodCase(ROPE, segments, 2.25, 0.0035, 1792.89, 3.0e7, 1.0e7)
    rod = make_rod(case, solver)
    level = (0.0, 0.0, 0.0, 1.0)
    rod.hold(0, "clamped", np.zeros(3), level)
    rod.hold(segments - 1, "clamped", np.array([case.span, 0.0, 0.0]), level)
    rod.lay_out()
    add_copies(rod, segments - 1, copies)
    rod.step(LEAD_TIME, round(LEAD_TIME / SUBSTEP[solver]))
    rod.set_velocity(segments - 1, CARRIED)
    return rod
