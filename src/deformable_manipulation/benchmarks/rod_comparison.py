"""The same two rods in this package and in other libraries: time, and error against theory."""

from functools import partial
from typing import List

from deformable_manipulation.benchmarks.comparison import COLUMNS, SETTLING_NOTE, Contest, OwnWay
from deformable_manipulation.benchmarks.package_rod import PackageRod
from deformable_manipulation.benchmarks.rivals.catalogue import ROD_RIVALS
from deformable_manipulation.benchmarks.rod_case import CANTILEVER, ROPE, RodCase
from deformable_manipulation.benchmarks.rod_theory import error_of
from deformable_manipulation.benchmarks.subject import Request
from deformable_manipulation.benchmarks.table import Column, Table
from deformable_manipulation.validation.rod import ROPE as ROPE_PROPERTIES
from deformable_manipulation.validation.rod import STIFF_ROD

SEGMENTS = (28, 100)
OWN = (  # solver, stretch, copies
    ("direct", "zero", 1),
    ("direct", "zero", 8),
    ("direct", "from_moduli", 1),
    ("gauss_seidel", "zero", 1),
)
PROPERTIES = {ROPE: ROPE_PROPERTIES, CANTILEVER: STIFF_ROD}

CASE_COLUMNS = (Column("case", "rod"), Column("segments", "segments", "d"))
NOTES = (
    "rope: E 30 MPa, both ends held 1.5 m apart and free to turn; error: largest deviation from "
    "the elastica over the length",
    "cantilever: E 30 GPa, clamped at one end; error: drop of the tip over that of the elastica, "
    "minus 1",
    SETTLING_NOTE,
)


def comparison_table(request: Request) -> Table:
    """Simulate both rods in every library."""
    columns = CASE_COLUMNS + COLUMNS
    table = Table("comparison", "The same rods in other libraries", columns, notes=list(NOTES))
    for case in _cases(request.quick):
        _contest(case).add_rows(table, request)
    return table


def _contest(case: RodCase) -> Contest:
    own = [
        OwnWay(
            f"{solver}, stretch {stretch}",
            copies,
            partial(PackageRod, case, solver, stretch, copies),
        )
        for solver, stretch, copies in OWN
    ]
    columns = {"case": case.load, "segments": case.segments}
    name = f"{case.load}, {case.segments} segments"
    return Contest(name, columns, case, own, ROD_RIVALS, error_of)


def _cases(quick: bool) -> List[RodCase]:
    loads, counts = ((ROPE,), SEGMENTS[:1]) if quick else ((ROPE, CANTILEVER), SEGMENTS)
    return [make_case(load, segments) for load in loads for segments in counts]


def make_case(load: str, segments: int) -> RodCase:
    """One of the two rods."""
    properties = PROPERTIES[load]
    return RodCase(
        load,
        segments,
        properties.length,
        properties.radius,
        properties.density,
        properties.young_modulus,
        properties.torsion_modulus,
    )
