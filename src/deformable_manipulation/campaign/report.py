"""A campaign in numbers, for people and programs."""

from typing import Any, Dict, List, Sequence, Tuple

import numpy as np

from deformable_manipulation.campaign.confidence import interval
from deformable_manipulation.campaign.outcome import (
    IMPOSSIBLE,
    POSSIBLE,
    UNKNOWN,
    RunOutcome,
    tolerance_of,
)
from deformable_manipulation.markdown.table import table
from deformable_manipulation.scenario.barriers import BARRIERS


def summarise(outcomes: Sequence[RunOutcome], tolerance: float) -> Dict[str, Any]:
    """Counts and worst values; lengths in m, loads in their units.

    Args:
        tolerance: [m] up to which a violation of a length does not count.
    """
    finished = [outcome for outcome in outcomes if outcome.completed]
    summary: Dict[str, Any] = {
        "runs": len(outcomes),
        "not_completed": len(outcomes) - len(finished),
        "tolerance": tolerance,
        "violations": {name: _violations(outcomes, name, tolerance) for name in _limits(outcomes)},
        "lowest_distance": min((o.min_distance for o in outcomes), default=None),
        "deadlocks": sum(outcome.deadlock for outcome in outcomes),
        "stuck": _counted(outcomes, lambda outcome: outcome.stuck),
        "waiting": sum(outcome.waits for outcome in outcomes),
        "answers": {
            answer: sum(outcome.answer == answer for outcome in outcomes)
            for answer in (IMPOSSIBLE, POSSIBLE, UNKNOWN)
        },
        "runs_with_relaxed_programs": sum(outcome.relaxed > 0 for outcome in outcomes),
        "relaxed_programs": sum(outcome.relaxed for outcome in outcomes),
        "failed_programs": sum(outcome.failed for outcome in outcomes),
    }
    for name in ("oscillation", "tracking_error", "final_error", "constrained"):
        summary[name] = _spread([getattr(outcome, name) for outcome in finished])
    return summary


def is_acceptable(summary: Dict[str, Any]) -> bool:
    """Whether all runs were done, limits were kept, and no assistant stood still without need."""
    return not (
        summary["not_completed"]
        or summary["deadlocks"]
        or summary["waiting"]
        or summary["failed_programs"]
        or any(violation["runs"] for violation in summary["violations"].values())
    )


def worst(outcomes: Sequence[RunOutcome]) -> RunOutcome:
    """The run that is most worth looking at: broken down, then failed, then furthest off limits."""

    def badness(outcome: RunOutcome) -> Tuple:
        violation = max(outcome.violations.values(), default=0.0)
        return (
            not outcome.completed,
            outcome.failed > 0,
            violation,
            outcome.deadlock,
            outcome.waits,
            outcome.oscillation,
            -outcome.index,
        )

    return max(outcomes, key=badness)


def describe(summary: Dict[str, Any]) -> str:
    """The summary for a reader at a terminal."""
    lines: List[str] = ["{runs} runs, {not_completed} not completed".format(**summary)]
    for name, violation in summary["violations"].items():
        worst_of_all = BARRIERS[name].show(violation["worst"], 2)
        lines.append(
            f"{name + ' violated':22}{violation['runs']} runs, {_percent(violation)}, "
            f"by {worst_of_all} at worst"
        )
    lines += _describe_answers(summary["answers"])
    lines.append(f"{'stuck':22}{summary['stuck']['runs']} runs, {_percent(summary['stuck'])}")
    lines.append(f"{'deadlocks':22}{summary['deadlocks']}, in free space")
    if summary["waiting"]:
        lines.append(
            f"{'waiting':22}{summary['waiting']} runs, in which an assistant stood still for most "
            "of the time, because something was not known to it"
        )
    lines.append(
        f"{'programs relaxed':22}{summary['relaxed_programs']} in "
        f"{summary['runs_with_relaxed_programs']} runs; failed {summary['failed_programs']}"
    )
    for key, text in (
        ("oscillation", "oscillation, RMS"),
        ("tracking_error", "error unconstrained"),
        ("final_error", "error at the end"),
    ):
        lines.append(
            f"{text:22}median {_millimetres(summary[key]['median'])}, "
            f"largest {_millimetres(summary[key]['most'])}"
        )
    return "\n".join(lines)


def _describe_answers(answers) -> List[str]:
    """What somebody who knows the leader's path could have done in the runs that missed a limit."""
    if not any(answers.values()):
        return []
    return [
        f"{'with foreknowledge':22}{answers[IMPOSSIBLE]} of these impossible for anybody, "
        f"{answers[POSSIBLE]} possible, {answers[UNKNOWN]} not known"
    ]


def _percent(counted) -> str:
    """The 95 % confidence interval of a fraction of runs."""
    low, high = counted["interval"]
    return f"{100.0 * low:.1f} to {100.0 * high:.1f} %"


def describe_classes(classes: Sequence[Sequence[RunOutcome]], tolerance: float) -> str:
    """A table of all classes: counts, worst amounts and 95 % confidence intervals."""
    names = _limits([outcome for outcomes in classes for outcome in outcomes])
    header = ["path", "speed [m/s]", "leader", "runs", *(f"{name} violated" for name in names)]
    header += ["stuck", "deadlocks", "programs relaxed", "impossible", "possible", "not known"]
    rows = []
    for outcomes in classes:
        summary = summarise(outcomes, tolerance)
        runs, first = summary["runs"], outcomes[0]
        cells = [first.path, f"{first.speed:g}", first.leader, str(runs)]
        for name in names:
            violation = summary["violations"].get(name)
            cells.append("" if violation is None else _missed(violation, name))
        cells += [_fraction(summary["stuck"]), str(summary["deadlocks"])]
        cells.append(str(summary["relaxed_programs"]))
        rows.append(cells + [str(count) for count in summary["answers"].values()])
    return table(header, rows)


def _missed(violation, name) -> str:
    amount = BARRIERS[name].show(violation["worst"], 2)
    worst_of_all = f", by {amount}" if violation["runs"] else ""
    return f"{_fraction(violation)}{worst_of_all}"


def _fraction(counted) -> str:
    return f"{counted['runs']} ({_percent(counted)})"


def _counted(outcomes, happened) -> Dict[str, Any]:
    count = sum(map(happened, outcomes))
    return {"runs": count, "interval": list(interval(count, len(outcomes)))}


def _limits(outcomes: Sequence[RunOutcome]) -> List[str]:
    """Names of the barriers in use."""
    return list(dict.fromkeys(name for outcome in outcomes for name in outcome.violations))


def _violations(outcomes, name, tolerance):
    amounts = [outcome.violations.get(name, 0.0) for outcome in outcomes]
    counted = _counted(amounts, lambda amount: amount > tolerance_of(name, tolerance))
    return {**counted, "worst": max(amounts, default=0.0)}


def _spread(values):
    if not values:
        return {"median": None, "p99": None, "most": None}
    median, p99 = np.percentile(values, [50, 99])
    return {"median": float(median), "p99": float(p99), "most": float(max(values))}


def _millimetres(metres) -> str:
    return "none" if metres is None else f"{1e3 * metres:.2f} mm"
