"""Tables of random runs, measured with ``run_campaign``."""

from typing import Dict, List, Sequence, Tuple

from deformable_manipulation.figures.runs import Say, run_campaign
from deformable_manipulation.markdown.table import millimetres, table

_PAPER = "controller.formulation=paper"
_CENTRALISED = "controller.cooperation=centralised"
# Scenario, replaced value, number of runs.
_CAMPAIGNS: Tuple[Tuple[str, str, int], ...] = (
    ("rope_one_assistant", "", 2000),
    ("rope_one_assistant", _PAPER, 500),
    ("rope_two_assistants", "", 500),
    ("rope_two_assistants", _CENTRALISED, 125),
    ("rope_two_assistants", _PAPER, 125),
)
_FABRIC = "fabric_three_assistants"
# Each with its share, and the margins of ropes.
_SHARES = (
    "controller.cooperation=decentralised controller.collision.margin=0.002 "
    "controller.collision.speed_margin=0"
)
# Replaced value, seeds, number of runs of each.
_FABRICS: Tuple[Tuple[str, Sequence[int], int], ...] = (
    ("", (1, 2, 3), 100),
    (_SHARES, (1,), 100),
    (_PAPER, (1,), 25),
)
_MOVING = "rope_moving_obstacle"
_STIFF = "stiff_rod_one_assistant"
# Options, what they do.
_TERMS: Tuple[Tuple[str, str], ...] = (
    ("", ""),
    ("--set controller.feedforward=false", "without the leader's velocity"),
    ("--set controller.collision.gradient=minimum", "one row, for the minimum distance"),
    ("--set controller.jacobian=perturbed_copies", "central differences of copies"),
    (
        "--set controller.jacobian=perturbed_copies --set controller.differences=forward",
        "forward differences of copies",
    ),
    ("--set controller.collision.margin=0", ""),
    ("--set controller.smoothing=0", ""),
    ("--set controller.collision.speed_margin=0.3", ""),
    (f"--set {_PAPER}", ""),
    ("--speed 0.2", "a leader that is faster than the assistants, 0.15 m/s"),
    (f"--speed 0.2 --set {_PAPER}", ""),
)
_KNOWLEDGE: Tuple[Sequence[str], ...] = (
    (),
    ("pose_noise=0.002",),
    ("pose_noise=0.005",),
    ("pose_delay=0.05",),
    ("pose_delay=0.1",),
    ("stiffness_factor=2",),
    ("stiffness_factor=0.5",),
    ("density_factor=2",),
    ("density_factor=0.5",),
    ("dropped_cycles=0.3",),
    ("pose_noise=0.002", "pose_delay=0.05", "dropped_cycles=0.1"),
    (
        "pose_noise=0.002",
        "pose_delay=0.05",
        "dropped_cycles=0.1",
        "stiffness_factor=2",
        "density_factor=0.5",
    ),
)
_ROWS_LIMIT = 0.052  # m, offset and margin of rope_one_assistant


def measure_campaigns(say: Say) -> Dict[str, str]:
    """Return the tables ``campaigns`` and ``campaigns_summary``, from the same campaigns."""
    found = {}
    for name, value, runs in _CAMPAIGNS:
        options = ["--runs", str(runs), "--seed", "1", "--duration", "60", *_set(value)]
        found[name, value] = run_campaign(name, options, say)
    return {"campaigns": _campaigns(found), "campaigns_summary": _summary(found)}


def measure_stiff_rods(say: Say) -> Dict[str, str]:
    """Return the table ``campaigns_stiff_rod``."""
    options = ["--runs", "200", "--seed", "1", "--duration", "60"]
    found = {(_STIFF, ""): run_campaign(_STIFF, options, say)}
    return {"campaigns_stiff_rod": _campaigns(found)}


def measure_fabrics(say: Say) -> Dict[str, str]:
    """Return the table ``campaigns_fabric``."""
    rows = []
    for value, seeds, runs in _FABRICS:
        for seed in seeds:
            options = ["--runs", str(runs), "--seed", str(seed), "--duration", "60", *_set(value)]
            one = run_campaign(_FABRIC, options, say)
            rows.append(
                [
                    f"`{value}`" if value else "full",
                    str(seed),
                    missed(one),
                    str(one["deadlocks"]),
                    str(one["relaxed_programs"]),
                ]
            )
    header = ["", "seed", "runs that missed a limit", "deadlocks", "programs relaxed"]
    return {"campaigns_fabric": table(header, rows)}


def measure_moving_obstacles(say: Say) -> Dict[str, str]:
    """Return the table ``campaigns_moving_obstacle``."""
    values = ("", "controller.disturbance_filter=0")
    options = ["--runs", "200", "--seed", "1", "--duration", "40"]
    found = {
        (_MOVING, value): run_campaign(_MOVING, [*options, *_set(value)], say) for value in values
    }
    return {"campaigns_moving_obstacle": _campaigns(found)}


def measure_terms(say: Say) -> Dict[str, str]:
    """Return the table ``terms``."""
    rows = []
    for options, meaning in _TERMS:
        fixed = ["--runs", "100", "--seed", "7", "--duration", "60"]
        found = run_campaign("rope_one_assistant", [*fixed, *options.split()], say)
        title = f"`{options}`" if options else "no option"
        distance = found["violations"]["collision"]
        rows.append(
            [
                f"{title}: {meaning}" if meaning else title,
                str(distance["runs"]),
                f"{millimetres(distance['worst'])} mm",
                _programs(found, "formulation=paper" in options),
                f"{millimetres(found['oscillation']['most'], 2)} mm",
            ]
        )
    header = ["options", "short of the offset", "worst", "programs relaxed; failed"]
    return {"terms": table([*header, "largest oscillation"], rows)}


def measure_knowledge(say: Say) -> Dict[str, str]:
    """Return the table ``knowledge``."""
    rows = []
    for values in _KNOWLEDGE:
        fixed = ["--runs", "6", "--seed", "1", "--duration", "60", "--material", "1"]
        changed = [word for value in values for word in _set(f"knowledge.{value}")]
        found = run_campaign("rope_one_assistant", [*fixed, *changed], say)
        needed = _ROWS_LIMIT - found["lowest_distance"]
        rows.append(
            [
                ", ".join(f"`{value}`" for value in values) or "none: everything is known",
                f"{millimetres(needed, 2)} mm" if needed > 5e-5 else "none",
                str(found["relaxed_programs"]),
                f"{millimetres(found['oscillation']['median'], 2)} mm",
                f"{millimetres(found['tracking_error']['median'])} mm",
            ]
        )
    header = ["`knowledge`", "margin needed", "programs relaxed", "oscillation, median"]
    return {"knowledge": table([*header, "error unconstrained, median"], rows)}


def _campaigns(found: Dict[Tuple[str, str], Dict]) -> str:
    header = ["scenario", "formulation", "runs", "short of the offset", "overstretched"]
    header += ["deadlocks", "programs relaxed; failed", "oscillation, median; largest"]
    rows: List[List[str]] = []
    for (name, value), one in found.items():
        violations = [one["violations"][kind] for kind in ("collision", "overstretch")]
        most = f"{millimetres(one['oscillation']['most'], 2)} mm"
        rows.append(
            [
                "" if value else f"`{name}`",
                f"`{value}`" if value else "full",
                str(one["runs"]),
                *(f"{each['runs']} ({millimetres(each['worst'])} mm)" for each in violations),
                str(one["deadlocks"]),
                _programs(one, value == _PAPER),
                f"{millimetres(one['oscillation']['median'], 2)}; {most}",
                f"{millimetres(one['tracking_error']['median'])} mm",
            ]
        )
    return table([*header, "error unconstrained, median"], rows)


def _summary(found: Dict[Tuple[str, str], Dict]) -> str:
    names = [name for name, value, _ in _CAMPAIGNS if not value]
    rows = [[f"`{name}`", missed(found[name, ""]), missed(found[name, _PAPER])] for name in names]
    return table(["", "this package", "paper's formulation"], rows)


def missed(one: Dict) -> str:
    """Runs that missed a limit: those of one campaign may miss several."""
    kinds = [
        f"{one['violations'][kind]['runs']} {text}, by up to "
        f"{millimetres(one['violations'][kind]['worst'])} mm"
        for kind, text in (("collision", "too close"), ("overstretch", "overstretched"))
        if one["violations"][kind]["runs"]
    ]
    return f"of {one['runs']}: " + "; ".join(kinds) if kinds else f"0 of {one['runs']}"


def _programs(found: Dict, paper: bool) -> str:
    return f"{'-' if paper else found['relaxed_programs']}; {found['failed_programs']}"


def _set(value: str) -> List[str]:
    return [word for each in value.split() for word in ("--set", each)]
