"""A run in numbers: the content of ``summary.json``."""

import json
import math
from typing import IO, Dict, List, Mapping, Optional

import numpy as np

from deformable_manipulation.control.status import Status
from deformable_manipulation.recording.provenance import machine, package_version
from deformable_manipulation.recording.run_data import RunData
from deformable_manipulation.recording.timeseries import TIMING_COLUMNS, TimeSeries
from deformable_manipulation.recording.waits import Wait, describe_waits
from deformable_manipulation.scenario.barriers import BARRIERS
from deformable_manipulation.scenario.spec import Scenario
from deformable_manipulation.simulation.stretch import largest_stretch, valid_stretch

_UNSTABLE_STARTS = {
    "moving": "the object still moved at the start",
    "balanced": "the object started in an unstable balance: it may fall over or snap",
}


def summarise(
    scenario: Scenario,
    series: TimeSeries,
    wall_time: float,
    completed: bool,
    safety: bool,
    start: str,
    waits: Mapping[str, Wait],
) -> dict:
    """The numbers of a run; None if there is none (no obstacle, nothing recorded).

    ``start`` is how the object rested at the start: ``stable``, ``moving`` or ``balanced``;
    ``waits`` how long each assistant, by its name, waited and why.
    ``duration`` is the simulated time, ``min_distance`` that of the object itself over the run,
    ``min_model_distance`` that of the model where the controllers see one, with its largest
    correction and the cycles in which it disagreed with what was measured,
    ``min_margin`` the lowest h of each barrier over the run, in its unit, ``max_stretch`` the
    largest relative change of length anywhere in it; where that is more than
    what the object's material allows, ``valid_stretch``, ``shape_valid`` is false.
    Lengths are in m, times in s unless the key says ms. Of ``timing``, ``solver`` is one quadratic
    program where the nominal velocity alone would not do.
    """
    offset = scenario.controller.collision.offset
    min_distance = _lowest(series.column("distance"))
    max_stretch = largest_stretch(series.column("stretch"))
    valid = valid_stretch(scenario)
    status = _of_assistants(series, "status")
    return {
        "scenario": scenario.name,
        "completed": completed,
        "safety": safety,
        "start": start,
        "duration": len(series) / scenario.controller.rate,
        "cycles": len(series),
        "rate": scenario.controller.rate,
        "wall_time": wall_time,
        "min_distance": min_distance,
        **_of_model(series),
        "offset": offset,
        "worst_violation": 0.0 if min_distance is None else max(0.0, offset - min_distance),
        "max_stretch": max_stretch,
        "valid_stretch": valid,
        "shape_valid": max_stretch is None or max_stretch <= valid,
        "min_margin": {
            name: _lowest(_of_assistants(series, f"h_{name}")) for name in series.barriers
        },
        "tracking_error": {
            name: _error_statistics(series.column(name + ".error_norm"))
            for name in series.assistants
        },
        "qp_relaxed": int(np.count_nonzero(status == Status.RELAXED)),
        "qp_failed": int(np.count_nonzero(status == Status.FAILED)),
        "waiting": {name: wait.summary(scenario.controller.rate) for name, wait in waits.items()},
        "timing": _timing(series, status),
        "version": package_version(),
        "machine": machine(),
    }


def write_summary(summary: dict, file: IO) -> None:
    """Write as strict JSON: JSON has no nan and no infinity, they become null."""
    json.dump(_without_non_finite(summary), file, indent=2, allow_nan=False)
    file.write("\n")


def describe(summary: dict) -> str:
    """The main numbers for a reader at a terminal, one per line."""
    duration = "{} of {:.2f} s simulated in {:.2f} s".format(
        "whole run" if summary["completed"] else "stopped early: run",
        summary["duration"],
        summary["wall_time"],
    )
    return "\n".join([duration, *_outcome_lines(summary)])


def describe_recorded(run: RunData) -> str:
    """The same numbers of a recorded run, as far as its recording has them."""
    status = np.concatenate([series.status for series in run.assistants])
    min_distance = _lowest(run.distance)
    violation = None
    if min_distance is not None and run.offset is not None:
        violation = max(0.0, run.offset - min_distance)
    max_stretch = run.max_stretch
    margins: Dict[str, List[np.ndarray]] = {}
    for series in run.assistants:
        for name, values in series.h.items():
            margins.setdefault(name, []).append(values)
    start, end = run.time_range
    rate = len(run.time) / (end - start)
    outcome = {
        "rate": rate,
        "min_distance": min_distance,
        "offset": run.offset,
        "worst_violation": violation,
        "max_stretch": max_stretch,
        "valid_stretch": run.valid_stretch,
        "shape_valid": max_stretch is None or max_stretch <= run.valid_stretch,
        "min_margin": {name: _lowest(np.concatenate(each)) for name, each in margins.items()},
        "tracking_error": {
            series.agent: _error_statistics(series.error_norm) for series in run.assistants
        },
        "qp_relaxed": int(np.count_nonzero(status == Status.RELAXED)),
        "qp_failed": int(np.count_nonzero(status == Status.FAILED)),
        "waiting": {series.agent: _wait_in(series.status, rate) for series in run.assistants},
    }
    return "\n".join(["recorded: {:.2f} s".format(end - start), *_outcome_lines(outcome)])


def _outcome_lines(summary: dict) -> List[str]:
    lines = [
        "lowest distance            {} (offset {})".format(
            _millimetres(summary["min_distance"]), _millimetres(summary["offset"])
        ),
        "worst violation            {}".format(_millimetres(summary["worst_violation"])),
    ]
    if summary.get("min_model_distance") is not None:
        lines.insert(1, "    of the model           " + _millimetres(summary["min_model_distance"]))
    for name, margin in summary["min_margin"].items():
        if name != "collision":  # told as distance
            label = "lowest {}".format(BARRIERS[name].margin)
            lines.append("{:27}{}".format(label, BARRIERS[name].show(margin)))
    for name, error in summary["tracking_error"].items():
        values = (_millimetres(error[key]) for key in ("rms", "max", "final"))
        lines.append("error of {}: rms {}, max {}, final {}".format(name, *values))
    lines += describe_waits(summary["waiting"], summary["rate"])
    start = summary.get("start")  # which bags do not tell
    if start in _UNSTABLE_STARTS:
        lines.append("WARNING: {}".format(_UNSTABLE_STARTS[start]))
    if not summary["shape_valid"]:
        lines.append(
            "WARNING: the object was stretched or squeezed by up to {:.1f} %; beyond {:.1f} % its "
            "shape and distances are not valid".format(
                100.0 * summary["max_stretch"], 100.0 * summary["valid_stretch"]
            )
        )
    lines.append("QPs relaxed {qp_relaxed}, failed {qp_failed}".format(**summary))
    return lines


def _wait_in(statuses: np.ndarray, rate: float) -> dict:
    """How long an assistant waited; recordings do not tell why."""
    wait = Wait()
    for status in statuses.tolist():
        wait.add(status)
    return wait.summary(rate)


def _of_assistants(series: TimeSeries, column: str) -> np.ndarray:
    """A column of every assistant, shape (assistants, rows)."""
    return np.array([series.column(f"{name}.{column}") for name in series.assistants])


def _lowest(values: np.ndarray) -> Optional[float]:
    finite = values[np.isfinite(values)]
    return float(finite.min()) if finite.size else None


def _of_model(series: TimeSeries) -> dict:
    """What is told of a model of the object, if the controllers see one."""
    if not series.modelled:
        return {}
    correction, disagrees = series.column("correction"), series.column("disagrees")
    return {
        "min_model_distance": _lowest(series.column("model_distance")),
        "max_correction": -(_lowest(-correction) or 0.0),
        "disagreeing": int(np.count_nonzero(disagrees == 1.0)),
    }


def _error_statistics(error: np.ndarray) -> dict:
    finite = error[np.isfinite(error)]
    if not finite.size:
        return {"rms": None, "max": None, "final": None}
    return {
        "rms": float(np.sqrt(np.mean(finite**2))),
        "max": float(finite.max()),
        "final": float(finite[-1]),
    }


def _timing(series: TimeSeries, status: np.ndarray) -> dict:
    seconds = {name: series.timing(name) for name in TIMING_COLUMNS}
    solved = np.isin(status, (Status.CONSTRAINED, Status.RELAXED))
    seconds["solver"] = _of_assistants(series, "solve_time")[solved]
    return {name: _milliseconds(values) for name, values in seconds.items()}


def _milliseconds(seconds: np.ndarray) -> dict:
    finite = 1e3 * seconds[np.isfinite(seconds)]
    if not finite.size:
        return {"median_ms": None, "p99_ms": None}
    median, p99 = np.percentile(finite, [50, 99])
    return {"median_ms": float(median), "p99_ms": float(p99)}


def _millimetres(metres: Optional[float]) -> str:
    return "none" if metres is None else f"{1e3 * metres:.1f} mm"


def _without_non_finite(value):
    if isinstance(value, dict):
        return {key: _without_non_finite(item) for key, item in value.items()}
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
