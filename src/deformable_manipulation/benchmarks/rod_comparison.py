"""The same two rods in this package and in other libraries: time, and error against theory."""

from functools import partial
from statistics import median
from typing import Callable, Iterator, List, Tuple

from deformable_manipulation._pbd import NonFiniteState
from deformable_manipulation.benchmarks.package_rod import PackageRod
from deformable_manipulation.benchmarks.rivals.catalogue import RIVALS
from deformable_manipulation.benchmarks.rivals.subprocess_trial import Outcome, run_in
from deformable_manipulation.benchmarks.rod_case import CANTILEVER, ROPE, RodCase
from deformable_manipulation.benchmarks.rod_theory import error_of
from deformable_manipulation.benchmarks.rod_trial import TrialError, run_trial
from deformable_manipulation.benchmarks.subject import Request
from deformable_manipulation.benchmarks.table import Column, Table
from deformable_manipulation.recording.provenance import package_version
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

COLUMNS = (
    Column("case", "rod"),
    Column("segments", "segments", "d"),
    Column("library", "library"),
    Column("copies", "copies", "d"),
    Column("step_ms", "step [ms]", ".3g"),
    Column("median_us", "per step [µs]", ".1f"),
    Column("minimum_us", "minimum [µs]", ".1f"),
    Column("settling_s", "settles in [s]", ".2f"),
    Column("settling_wall_ms", "which takes [ms]", ".3g"),
    Column("error_percent", "error [%]", ".4f"),
    Column("remark", "remark"),
)
NOTES = (
    "rope: E 30 MPa, both ends held 1.5 m apart and free to turn; error: largest deviation from "
    "the elastica over the length",
    "cantilever: E 30 GPa, clamped at one end; error: drop of the tip over that of the elastica, "
    "minus 1",
    "settles: simulated time until every point stays within 1 mm of its place at rest, and the "
    "time that its steps take to compute",
)

Trial = Callable[[], Outcome]


def comparison_table(request: Request) -> Table:
    """Simulate both rods in every library."""
    table = Table("comparison", "The same rods in other libraries", COLUMNS, notes=list(NOTES))
    for case in _cases(request.quick):
        for library, copies, options, trial in _trials(case, request):
            request.say(f"{case.load}, {case.segments} segments, {library} {options}".rstrip())
            row = {"case": case.load, "segments": case.segments, "copies": copies}
            table.rows.append({**row, "library": library, **_result(trial(), case)})
    return table


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


def _trials(case: RodCase, request: Request) -> Iterator[Tuple[str, int, str, Trial]]:
    """Name, copies, options and the trial itself: first this package's, then the others'."""
    for solver, stretch, copies in OWN:
        model = partial(PackageRod, case, solver, stretch, copies)
        options = f"{solver}, stretch {stretch}, {copies} copies"
        yield "this package", copies, options, partial(_own, model, case, request)
    for rival in RIVALS:
        options = ", ".join(f"{key} {value}" for key, value in rival.options.items())
        yield rival.name, 1, options, partial(run_in, request.rivals, rival, case, request.effort)


def _own(model: Callable[[], PackageRod], case: RodCase, request: Request) -> Outcome:
    version = package_version() or ""
    try:
        return Outcome(run_trial(model(), case, request.effort), version)
    except (TrialError, NonFiniteState) as error:
        return Outcome(None, version, f"failed: {error}")


def _result(outcome: Outcome, case: RodCase) -> dict:
    trial = outcome.trial
    if trial is None:
        return {"version": outcome.version, "remark": outcome.problem}
    step = median(trial.step_seconds)
    result = {
        "version": outcome.version,
        "step_ms": 1e3 * trial.time_step,
        "median_us": 1e6 * step,
        "minimum_us": 1e6 * min(trial.step_seconds),
        "remark": trial.settings,
    }
    if trial.settling_time is None:
        result["remark"] += "; did not come to rest"
        return result
    result["settling_s"] = trial.settling_time
    result["settling_wall_ms"] = 1e3 * step * trial.settling_time / trial.time_step
    result["error_percent"] = 100.0 * error_of(trial, case)
    return result
