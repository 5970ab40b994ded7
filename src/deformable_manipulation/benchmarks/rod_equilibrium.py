"""Microseconds for a rod's quasi-static equilibrium with its gradient, cycle after cycle."""

from deformable_manipulation import _pbd
from deformable_manipulation.benchmarks.harness import measure
from deformable_manipulation.benchmarks.rod_substep import SEGMENTS, carried_rope
from deformable_manipulation.benchmarks.subject import Request
from deformable_manipulation.benchmarks.table import Column, Table

COPIES = (1, 7)  # the object alone; and with six copies, a held end displaced by 0.1 m
CYCLE = (0.0, -0.0006, 0.0008)  # m that the held end moves in a cycle: 0.1 m/s at 100 Hz

COLUMNS = (
    Column("segments", "segments", "d"),
    Column("copies", "copies", "d"),
    Column("newton_steps", "Newton steps", "d"),
    Column("median_us", "median [µs]", ".1f"),
    Column("minimum_us", "minimum [µs]", ".1f"),
)
NOTES = (
    "each starts from that of the cycle before, a held end 1 mm away; with the derivative of every "
    "point of the object with respect to both held points",
)


def equilibrium_table(request: Request) -> Table:
    """Time every combination."""
    title = "Equilibrium of the rope with its gradient, one thread"
    table = Table("equilibrium", title, COLUMNS, notes=list(NOTES))
    for segments in SEGMENTS[:1] if request.quick else SEGMENTS:
        for copies in COPIES:
            request.say(f"equilibrium, {segments} segments, {copies} copies")
            table.rows.append(_row(segments, copies, request))
    return table


def _row(segments: int, copies: int, request: Request) -> dict:
    here, there = _two_cycles(segments, copies)
    equilibrium = _pbd.RodEquilibrium()

    def cycles(_) -> None:
        for rod in (here, there):
            equilibrium.update(rod, copies)
            equilibrium.response()

    timing = measure(cycles, effort=request.effort).per(2)
    for copy in range(copies):
        if not equilibrium.valid(copy):
            raise RuntimeError(f"{segments} segments, copy {copy}: {equilibrium.status(copy)}")
    return {
        "segments": segments,
        "copies": copies,
        "newton_steps": equilibrium.iterations,
        "median_us": 1e6 * timing.median,
        "minimum_us": 1e6 * timing.minimum,
        "repetitions": len(timing.seconds),
    }


def _two_cycles(segments: int, copies: int):
    """The rope with its last end at one place and at that of the next cycle."""
    here = carried_rope("direct", segments, copies)
    there = here.clone()
    last = segments - 1
    position, orientation = here.positions()[last], here.orientations()[last]
    there.set_pose(last, position + CYCLE, orientation)
    return here, there
