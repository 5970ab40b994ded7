"""The report's tables, from what the runs and campaigns have recorded."""

import json
from typing import Any, Dict, List, NamedTuple, Sequence

from deformable_manipulation.recording import run_files
from deformable_manipulation.reproduction.paper import PUBLISHED
from deformable_manipulation.reproduction.plan import FULL, VARIANTS, Plan

_NONE = "–"
_PAIR_BARRIERS = ("overstretch", "proximity")
_NEGLIGIBLE = 1e-6  # m


class Table(NamedTuple):
    """A table of texts."""

    header: Sequence[str]
    rows: Sequence[Sequence[str]]


def safety_table(plan: Plan) -> Table:
    """What the paper's runs and those here kept of their limits, in mm."""
    header = (
        ("scenario", "formulation", "offset [mm]", "lowest distance [mm]")
        + ("lowest overstretch margin [mm]", "lowest proximity margin [mm]")
        + ("programs relaxed", "failed", "largest error at the end [mm]")
    )
    rows = []
    for name in plan.scenarios:
        paper = PUBLISHED.get(name)
        if paper and paper.min_distance is not None:
            known = (millimetres(paper.offset), millimetres(paper.min_distance))
            rows.append((name, "reported in the paper", *known, *[_NONE] * (len(header) - 4)))
        for variant, (title, _) in VARIANTS.items():
            summary = read_summary(plan, name, variant)
            finals = [error["final"] for error in summary["tracking_error"].values()]
            rows.append(
                (name, title)
                + tuple(millimetres(summary[key]) for key in ("offset", "min_distance"))
                + tuple(millimetres(summary["min_margin"][name]) for name in _PAIR_BARRIERS)
                + (str(summary["qp_relaxed"]), str(summary["qp_failed"]))
                + (millimetres(max(finals, default=None)),)
            )
    return Table(header, rows)


def time_table(plan: Plan) -> Table:
    """Times of the paper and of the full runs here, in ms."""
    header = ("scenario", "", "simulations", "minimum distance", "QP solver")
    rows = []
    for name in plan.scenarios:
        times = PUBLISHED[name].times if name in PUBLISHED else None
        if times:
            rows.append((name, "paper, average", *(f"{value:.1f}" for value in times)))
        rows.append((name, "here, median", *_times(plan, name)))
    return Table(header, rows)


def campaign_table(plan: Plan) -> Table:
    """What every campaign counted."""
    header = ("scenario", "formulation", "runs", "runs short of the offset", "by at most [mm]") + (
        "runs overstretched",
        "by at most [mm]",
        "deadlocks",
        "programs failed",
    )
    rows = []
    for name, variant in plan.campaigns():
        path = plan.campaign_folder(name, variant) / "campaign.json"
        summary = json.loads(path.read_text(encoding="utf-8"))["summary"]
        cells = [name, VARIANTS[variant][0], str(summary["runs"])]
        for kind in ("collision", "overstretch"):
            violation = summary["violations"][kind]
            cells += [str(violation["runs"]), millimetres(violation["worst"])]
        rows.append((*cells, str(summary["deadlocks"]), str(summary["failed_programs"])))
    return Table(header, rows)


def read_summary(plan: Plan, scenario: str, variant: str) -> Dict[str, Any]:
    """The ``summary.json`` of a run."""
    path = plan.run_folder(scenario, variant) / run_files.SUMMARY
    return json.loads(path.read_text(encoding="utf-8"))


def millimetres(metres) -> str:
    """A length [m] in mm, or a dash where there is none."""
    if metres is None:
        return _NONE
    if 0.0 < abs(metres) < _NEGLIGIBLE:
        return f"< {1e3 * _NEGLIGIBLE:g}"
    digits = 1 if abs(metres) >= 1e-4 else 3
    return f"{1e3 * metres:.{digits}f}"


def _times(plan: Plan, scenario: str) -> List[str]:
    timing = read_summary(plan, scenario, FULL)["timing"]
    medians = [timing[part]["median_ms"] for part in ("simulation", "distance", "solver")]
    return [_NONE if value is None else f"{value:.3f}" for value in medians]
