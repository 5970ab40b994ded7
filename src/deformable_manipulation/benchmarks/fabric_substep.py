"""Microseconds per substep of the fabric, and memory, by size and copies."""

from deformable_manipulation import _pbd
from deformable_manipulation.benchmarks.copies import COLUMNS, add_copies, time_substep
from deformable_manipulation.benchmarks.machine import allocated
from deformable_manipulation.benchmarks.package_fabric import PART, make_case, make_held
from deformable_manipulation.benchmarks.subject import Request
from deformable_manipulation.benchmarks.table import Column, Table

PARTICLES = (8, 15, 30, 60)  # along a side
QUICK_PARTICLES = (8, 15)
COPIES = (1, 4, 8, 13, 19)  # the object among them
SUBSTEP = 0.001  # s
CALL = 10  # substeps in one call of the timed Fabric.step
CARRIED = (0.0, -0.02, 0.05)  # m/s, of a corner: as one that follows an agent
LEAD_TIME = 1.0  # s, until the copies have arrived at their displacements

CASE_COLUMNS = (Column("particles", "cloth"),)
MEMORY = Column("memory", "memory [MB]", ".2f")


def substep_table(request: Request) -> Table:
    """Time every combination."""
    columns = CASE_COLUMNS + COLUMNS + (MEMORY,)
    table = Table("substep", "One substep of the cloth, all copies, one thread", columns)
    for particles in QUICK_PARTICLES if request.quick else PARTICLES:
        for copies in COPIES:
            request.say(f"cloth {particles}x{particles}, {copies} copies")
            fabric = carried_cloth(particles, copies)
            row = {"particles": f"{particles}x{particles}", "memory": _memory(fabric)}
            table.rows.append({**row, **time_substep(fabric, SUBSTEP, CALL, request.effort)})
    table.notes += [
        f"substeps of {1e3 * SUBSTEP:g} ms, {CALL} in one call from Python; instruction set: "
        f"{_pbd.instruction_set()}",
        "memory: what one fabric and its copies have allocated",
    ]
    return table


def carried_cloth(particles: int, copies: int) -> _pbd.Fabric:
    """The cloth held at its corners 1.8 m apart, in motion, its copies displaced."""
    case = make_case(particles)
    fabric = make_held(case, PART)
    add_copies(fabric, case.held[0], copies)
    fabric.step(LEAD_TIME, round(LEAD_TIME / SUBSTEP))
    fabric.set_velocity(case.held[0], CARRIED)
    return fabric


def _memory(fabric: _pbd.Fabric) -> float:
    """What a fabric with its copies has allocated [MB]; NaN where that is not known."""
    before = allocated()
    clone = fabric.clone()
    after = allocated()
    del clone
    return 1e-6 * (after - before)
