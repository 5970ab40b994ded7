"""A campaign in numbers, for people and programs."""

from typing import Any, Dict, List, Sequence, Tuple

import numpy as np

from deformable_manipulation.campaign.outcome import RunOutcome


def summarise(outcomes: Sequence[RunOutcome], tolerance: float) -> Dict[str, Any]:
    """Counts and worst values; lengths in m.

    Args:
        tolerance: [m] up to which a violation does not count.
    """
    finished = [outcome for outcome in outcomes if outcome.completed]
    summary: Dict[str, Any] = {
        "runs": len(outcomes),
        "not_completed": len(outcomes) - len(finished),
        "tolerance": tolerance,
        "violations": {name: _violations(outcomes, name, tolerance) for name in _limits(outcomes)},
        "lowest_distance": min((o.min_distance for o in outcomes), default=None),
        "deadlocks": sum(outcome.deadlock for outcome in outcomes),
        "runs_with_relaxed_programs": sum(outcome.relaxed > 0 for outcome in outcomes),
        "relaxed_programs": sum(outcome.relaxed for outcome in outcomes),
        "failed_programs": sum(outcome.failed for outcome in outcomes),
    }
    for name in ("oscillation", "tracking_error", "final_error", "constrained"):
        summary[name] = _spread([getattr(outcome, name) for outcome in finished])
    return summary


def is_acceptable(summary: Dict[str, Any]) -> bool:
    """Whether no limit was violated, no run broke down or deadlocked, no program failed."""
    return not (
        summary["not_completed"]
        or summary["deadlocks"]
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
            outcome.oscillation,
            -outcome.index,
        )

    return max(outcomes, key=badness)


def describe(summary: Dict[str, Any]) -> str:
    """The summary for a reader at a terminal."""
    lines: List[str] = ["{runs} runs, {not_completed} not completed".format(**summary)]
    for name, violation in summary["violations"].items():
        worst_of_all = _millimetres(violation["worst"])
        lines.append(f"{name + ' violated':22}{violation['runs']} runs, by {worst_of_all} at worst")
    lines.append(f"{'deadlocks':22}{summary['deadlocks']}")
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


def _limits(outcomes: Sequence[RunOutcome]) -> List[str]:
    """Names of the barriers in use."""
    return list(dict.fromkeys(name for outcome in outcomes for name in outcome.violations))


def _violations(outcomes, name, tolerance):
    amounts = [outcome.violations.get(name, 0.0) for outcome in outcomes]
    return {
        "runs": sum(amount > tolerance for amount in amounts),
        "worst": max(amounts, default=0.0),
    }


def _spread(values):
    if not values:
        return {"median": None, "p99": None, "most": None}
    median, p99 = np.percentile(values, [50, 99])
    return {"median": float(median), "p99": float(p99), "most": float(max(values))}


def _millimetres(metres) -> str:
    return "none" if metres is None else f"{1e3 * metres:.2f} mm"
