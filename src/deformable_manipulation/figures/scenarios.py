"""Tables of the scenarios that come with the package, measured with ``run_scenario``."""

from typing import Dict, Sequence, Tuple

from deformable_manipulation.figures.runs import Say, run_scenario
from deformable_manipulation.markdown.table import millimetres, table
from deformable_manipulation.reproduction.plan import FULL, PAPER, UNFILTERED, VARIANTS

ROPES = (
    "rope_one_assistant",
    "stiff_rod_one_assistant",
    "rope_two_assistants",
    "rope_moving_obstacle",
)
FABRICS = ("fabric_three_assistants",)  # minutes each
_MOVING_OBSTACLE = (
    (),
    ("--set", "controller.collision.obstacle_velocity=false"),
    ("--set", "controller.formulation=paper"),
    ("--no-safety",),
)
_NEGLIGIBLE = 1e-6  # m


def measure_ropes(say: Say) -> Dict[str, str]:
    """Return the tables ``scenarios`` and ``margins``, which come from the same runs."""
    runs = _run_variants(ROPES, say)
    return {"scenarios": _distances(ROPES, runs), "margins": _margins(ROPES, runs)}


def measure_fabrics(say: Say) -> Dict[str, str]:
    """Return the same tables of the fabric, ``fabric_scenario`` and ``fabric_margins``."""
    runs = _run_variants(FABRICS, say)
    return {
        "fabric_scenario": _distances(FABRICS, runs),
        "fabric_margins": _margins(FABRICS, runs),
    }


def measure_moving_obstacle(say: Say) -> Dict[str, str]:
    """Return the table ``moving_obstacle``."""
    rows = []
    for options in _MOVING_OBSTACLE:
        summary = run_scenario("rope_moving_obstacle", options, say)
        title = f"`{' '.join(options)}`" if options else "no option"
        relaxed = "" if options == ("--no-safety",) else str(summary["qp_relaxed"])
        rows.append([title, millimetres(summary["min_distance"]), relaxed])
    header = ["options of `run_scenario rope_moving_obstacle`", "lowest distance [mm]"]
    return {"moving_obstacle": table([*header, "programs relaxed"], rows)}


def _run_variants(names: Sequence[str], say: Say) -> Dict[Tuple[str, str], Dict]:
    """Summaries by scenario and variant."""
    return {
        (name, variant): run_scenario(name, options, say)
        for name in names
        for variant, (_, options) in VARIANTS.items()
    }


def _distances(names: Sequence[str], runs: Dict[Tuple[str, str], Dict]) -> str:
    header = ["lowest distance [mm]", "required", "this package", "paper's formulation"]
    rows = [
        [f"`{name}`", millimetres(runs[name, FULL]["offset"], 0)]
        + [millimetres(runs[name, each]["min_distance"]) for each in (FULL, PAPER, UNFILTERED)]
        for name in names
    ]
    return table([*header, "safety filter off"], rows)


def _margins(names: Sequence[str], runs: Dict[Tuple[str, str], Dict]) -> str:
    header = ["scenario", "formulation", "required distance", "lowest distance"]
    header += ["overstretch margin", "error at the end", "programs relaxed; failed"]
    rows = []
    for name in names:
        for variant in (FULL, PAPER):
            run = runs[name, variant]
            lengths = (run["offset"], run["min_distance"], run["min_margin"]["overstretch"])
            cells = [f"{millimetres(each)} mm" for each in lengths] + [_final_error(run)]
            relaxed = run["qp_relaxed"] if variant == FULL else "-"
            cells.append(f"{relaxed}; {run['qp_failed']}")
            rows.append([f"`{name}`" if variant == FULL else "", variant, *cells])
    return table(header, rows)


def _final_error(run: Dict) -> str:
    largest = max(error["final"] for error in run["tracking_error"].values())
    if largest < _NEGLIGIBLE:
        return f"below {millimetres(_NEGLIGIBLE, 3)} mm"
    return f"{millimetres(largest, 3)} mm"
