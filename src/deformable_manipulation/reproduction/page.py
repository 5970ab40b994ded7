"""The report as one HTML file that holds its pictures."""

import base64
from pathlib import Path
from typing import Dict, NamedTuple, Sequence, Tuple

from deformable_manipulation.reproduction.plan import FULL, VARIANTS, Plan
from deformable_manipulation.reproduction.tables import (
    Table,
    campaign_table,
    millimetres,
    read_summary,
    safety_table,
    time_table,
)

_TEMPLATE = "report.html.j2"


class Picture(NamedTuple):
    """A PNG in the page."""

    caption: str
    data: str  # base64


class Section(NamedTuple):
    """A scenario's part of the page."""

    title: str
    sentence: str
    pictures: Sequence[Picture]


def write_page(plan: Plan, path: Path, machine: Dict[str, str], elapsed: float) -> None:
    """Write the report of everything that the plan's jobs have made.

    Args:
        machine: what it was made on.
        elapsed: [s] that the jobs took.

    Raises:
        OSError: a part is missing, or the page cannot be written.
    """
    # Imported late: needed at the end of minutes of work, checked by its own test.
    from jinja2 import Environment, PackageLoader, StrictUndefined, select_autoescape

    environment = Environment(
        loader=PackageLoader("deformable_manipulation.reproduction", "."),
        autoescape=select_autoescape(("j2",)),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    text = environment.get_template(_TEMPLATE).render(
        sections=[_section(plan, name) for name in plan.scenarios],
        tables=_tables(plan),
        campaign_pictures=[
            _picture(
                plan.campaign_folder(name, variant) / "campaign.png",
                f"{name}, {VARIANTS[variant][0]}",
            )
            for name, variant in plan.campaigns()
        ],
        machine=machine,
        elapsed=elapsed,
        overrides=plan.overrides,
    )
    path.write_text(text, encoding="utf-8")


def _tables(plan: Plan) -> Dict[str, Table]:
    tables = {"safety": safety_table(plan), "times": time_table(plan)}
    if plan.campaigns():
        tables["campaigns"] = campaign_table(plan)
    return tables


def _section(plan: Plan, name: str) -> Section:
    summary = read_summary(plan, name, FULL)
    sentence = (
        f"{summary['duration']:g} s simulated in {summary['wall_time']:.1f} s; lowest distance "
        f"{millimetres(summary['min_distance'])} mm, offset {millimetres(summary['offset'])} mm."
    )
    paths = sorted(plan.figure_folder(name).glob("*.png"), key=_rank)
    pictures = [_picture(path, _caption(path, name)) for path in paths]
    return Section(name, sentence, pictures)


def _caption(path: Path, scenario: str) -> str:
    if path.stem == "overview":
        return "The whole run: shapes at some times, then distance, errors and margins over time"
    if path.stem.startswith("controller_"):
        agent = path.stem[len("controller_") :]
        return f"What {agent} saw and did: distance, error, margins and velocities over time"
    return f"{scenario} in RViz, with the distance to the obstacles at each time"


def _rank(path: Path) -> Tuple[int, str]:
    """RViz's picture first, then the overview, then the controllers in their order."""
    ranks = {"overview": 1, "controller": 2}
    return ranks.get(path.stem.split("_")[0], 0), path.stem


def _picture(path: Path, caption: str) -> Picture:
    return Picture(caption, base64.b64encode(path.read_bytes()).decode("ascii"))
