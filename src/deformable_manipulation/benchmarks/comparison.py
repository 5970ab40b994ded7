"""The same object in this package and in other libraries: time, and error against theory."""

from dataclasses import dataclass
from functools import partial
from statistics import median
from typing import Any, Callable, Dict, Iterator, Sequence, Tuple

from deformable_manipulation._pbd import NonFiniteState
from deformable_manipulation.benchmarks.rivals.catalogue import Rival
from deformable_manipulation.benchmarks.rivals.subprocess_trial import Outcome, run_in
from deformable_manipulation.benchmarks.subject import Request
from deformable_manipulation.benchmarks.table import Column, Table
from deformable_manipulation.benchmarks.trial import Case, Model, Trial, TrialError, run_trial
from deformable_manipulation.recording.provenance import package_version

COLUMNS = (
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
SETTLING_NOTE = (
    "settles: simulated time until every point stays within 1 mm of its place at rest, and the "
    "time that its steps take to compute"
)


@dataclass(frozen=True)
class OwnWay:
    """One way to simulate the object in this package."""

    options: str
    copies: int
    model: Callable[[], Model]


@dataclass(frozen=True)
class Contest:
    """One case for all libraries."""

    name: str
    columns: Dict[str, Any]  # of its rows
    case: Case
    own: Sequence[OwnWay]
    rivals: Sequence[Rival]
    error_of: Callable[[Trial, Case], float]  # relative [1]; RuntimeError: nothing to compare with

    def add_rows(self, table: Table, request: Request) -> None:
        """Simulate it in every library: first in this package, then in the others."""
        for library, copies, options, trial in self._trials(request):
            request.say(f"{self.name}, {library} {options}".rstrip())
            row = {**self.columns, "library": library, "copies": copies}
            table.rows.append({**row, **self._result(trial())})

    def _trials(self, request: Request) -> Iterator[Tuple[str, int, str, Callable[[], Outcome]]]:
        for way in self.own:
            options = f"{way.options}, {way.copies} copies"
            yield "this package", way.copies, options, partial(self._own, way, request)
        for rival in self.rivals:
            options = ", ".join(f"{key} {value}" for key, value in rival.options.items())
            trial = partial(run_in, request.rivals, rival, self.case, request.effort)
            yield rival.name, 1, options, trial

    def _own(self, way: OwnWay, request: Request) -> Outcome:
        version = package_version() or ""
        try:
            return Outcome(run_trial(way.model(), self.case, request.effort), version)
        except (TrialError, NonFiniteState) as error:
            return Outcome(None, version, f"failed: {error}")

    def _result(self, outcome: Outcome) -> dict:
        trial = outcome.trial
        if trial is None:
            return {"version": outcome.version, "remark": outcome.problem}
        step = median(trial.step_seconds)
        result: Dict[str, Any] = {
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
        try:
            result["error_percent"] = 100.0 * self.error_of(trial, self.case)
        except RuntimeError as error:
            result["remark"] += f"; {error}"
        return result
