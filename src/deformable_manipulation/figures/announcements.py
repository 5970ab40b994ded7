"""Tables of runs in which the leader announces its path, or something else."""

from typing import Dict, List, Tuple

from deformable_manipulation.figures.campaigns import missed
from deformable_manipulation.figures.runs import Say, run_campaign, run_classes
from deformable_manipulation.markdown.table import table

_NAME = "rope_one_assistant"
_OPTIONS = ("--runs", "40", "--seed", "11", "--duration", "50", "--speed", "0.3")
_CLASSES = ("--path", "places,dives", "--leader", "fading,announced", "--foreknowledge")
_ANNOUNCED = {"fading": "nothing", "announced": "its path"}
# Kind of announcement, what it is.
_WRONG: Tuple[Tuple[str, str], ...] = (
    ("opposite", "the opposite way"),
    ("delayed", "its path, 1 s late"),
    ("scaled", "twice the way"),
    ("random", "a random velocity, another one every second"),
)
_HEADER = ("missed a limit", "95 % interval, too close; overstretched", "stuck", "programs relaxed")


def measure_announcements(say: Say) -> Dict[str, str]:
    """Return the table ``announcements``."""
    rows: List[List[str]] = []
    for each in run_classes(_NAME, [*_OPTIONS, *_CLASSES], say):
        answers = each["summary"]["answers"]
        counts = "; ".join(str(answers[name]) for name in ("impossible", "possible", "unknown"))
        path, announced = each["ranges"]["path"], _ANNOUNCED[each["leader"]]
        rows.append([path, announced, *outcome(each["summary"]), counts])
    header = ["leader's path", "it announces", *_HEADER, "impossible; possible; not known"]
    return {"announcements": table(header, rows)}


def measure_wrong_announcements(say: Say) -> Dict[str, str]:
    """Return the table ``wrong_announcements``."""
    rows: List[List[str]] = []
    for kind, meaning in _WRONG:
        options = ["--leader", "announced", "--set", f"knowledge.intent={kind}"]
        rows.append([meaning, *outcome(run_campaign(_NAME, [*_OPTIONS, *options], say))])
    return {"wrong_announcements": table(["it announces", *_HEADER], rows)}


def outcome(summary: Dict) -> List[str]:
    """Cells of a campaign."""
    stuck, relaxed = summary["stuck"]["runs"], summary["relaxed_programs"]
    return [missed(summary), intervals(summary), str(stuck), str(relaxed)]


def intervals(summary: Dict) -> str:
    """The 95 % intervals of the shares of runs too close, and overstretched."""
    ends = [summary["violations"][kind]["interval"] for kind in ("collision", "overstretch")]
    return "; ".join(f"{100.0 * low:.1f} to {100.0 * high:.1f} %" for low, high in ends)
