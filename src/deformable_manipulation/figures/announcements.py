"""A table of runs in which the leader announces its path, or something else."""

from typing import Dict, List, Tuple

from deformable_manipulation.figures.campaigns import missed
from deformable_manipulation.figures.runs import Say, run_classes
from deformable_manipulation.markdown.table import table

_NAME = "rope_one_assistant"
_OPTIONS = ("--runs", "40", "--seed", "11", "--duration", "50", "--speed", "0.3")
# Kind of announcement, what it is.
_WRONG: Tuple[Tuple[str, str], ...] = (
    ("opposite", "the opposite way"),
    ("delayed", "its path, 1 s late"),
    ("scaled", "twice the way"),
    ("random", "a random velocity"),
)


def measure_announcements(say: Say) -> Dict[str, str]:
    """Return the table ``announcements``."""
    both = ["--path", "places,dives", "--leader", "fading,announced", "--foreknowledge"]
    rows: List[List[str]] = []
    for each in run_classes(_NAME, [*_OPTIONS, *both], say):
        announced = "its path" if each["leader"] == "announced" else "nothing"
        rows.append(_row(each, announced))
    for kind, meaning in _WRONG:
        wrong = ["--path", "dives", "--leader", "announced", "--set", f"knowledge.intent={kind}"]
        rows += [_row(each, meaning) for each in run_classes(_NAME, [*_OPTIONS, *wrong], say)]
    header = ["leader's path", "it announces", "missed a limit", "95 % interval", "stuck"]
    return {"announcements": table([*header, "impossible; possible; not known"], rows)}


def _row(one: Dict, announced: str) -> List[str]:
    summary, path = one["summary"], one["ranges"]["path"]
    answers = summary["answers"]
    intervals = [
        "{:.0f} to {:.0f} %".format(
            *(100.0 * end for end in summary["violations"][kind]["interval"])
        )
        for kind in ("collision", "overstretch")
    ]
    return [
        path,
        announced,
        missed(summary),
        "; ".join(intervals),
        str(summary["stuck"]["runs"]),
        "; ".join(str(answers[answer]) for answer in ("impossible", "possible", "unknown")),
    ]
