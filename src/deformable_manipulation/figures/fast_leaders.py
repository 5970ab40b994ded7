"""The table of leaders that are faster than the assistants, measured with ``run_campaign``."""

from typing import Dict, List, Sequence, Tuple

from deformable_manipulation.figures.announcements import intervals
from deformable_manipulation.figures.campaigns import missed
from deformable_manipulation.figures.runs import Say, run_classes
from deformable_manipulation.markdown.table import table

_ROPE, _TWO, _ROD = "rope_one_assistant", "rope_two_assistants", "stiff_rod_one_assistant"
_COMMON = ("--seed", "31", "--duration", "50")
_ALL = ("--speed", "0.1,0.2,0.3")
_FAST = ("--speed", "0.2,0.3")
_FASTEST = ("--speed", "0.3")
_DIVES = ("--speed", "0.3", "--path", "dives")
_ANNOUNCED = ("--leader", "announced")
_PRESENT = ("--set", "controller.horizon.length=0")
_PAPER = ("--set", "controller.formulation=paper")
# Columns: what the controllers do, their options, the numbers of runs of each class.
_COLUMNS: Tuple[Tuple[str, Sequence[str], Dict[str, int]], ...] = (
    ("horizon of 3 s", (), {_ROPE: 125, _TWO: 50, _ROD: 60}),
    ("its path announced", _ANNOUNCED, {_ROPE: 125}),
    ("present cycle only", _PRESENT, {_ROPE: 125, _TWO: 50, _ROD: 60}),
)
_FOREKNOWN = ("--foreknowledge",)
_BESIDE: Tuple[Tuple[str, Sequence[str], Dict[str, int]], ...] = (
    ("paper", _PAPER, {_ROPE: 40, _TWO: 20}),
    ("horizon of 3 s", _FOREKNOWN, {_ROPE: 125, _TWO: 50}),
    ("its path announced", _ANNOUNCED, {_TWO: 50}),
)

Row = Tuple[str, str, float]  # scenario, kind of path, speed


def measure_fast_leaders(say: Say) -> Dict[str, str]:
    """Return the table ``fast_leaders``."""
    columns: List[Dict[Row, Dict]] = [
        _measured(options, runs, say) for _, options, runs in _COLUMNS
    ]
    rows = []
    for row in columns[0]:
        name, path, speed = row
        cells = [_cell(column.get(row)) for column in columns]
        leader = f"{path}, {speed:g} m/s"
        rows.append([f"`{name}`", leader, cells[0], intervals(columns[0][row]), *cells[1:]])
    header = [title for title, _, _ in _COLUMNS]
    interval = "its 95 % interval, too close; overstretched"
    return {"fast_leaders": table(["scenario", "leader", header[0], interval, *header[1:]], rows)}


def measure_fast_leaders_beside(say: Say) -> Dict[str, str]:
    """Return the table ``fast_leaders_beside``: the paper, and who could have answered at all."""
    paper, horizon, announced = (_measured(options, runs, say) for _, options, runs in _BESIDE)
    rows = []
    for row in paper:
        name, path, speed = row
        cells = [_cell(column.get(row)) for column in (paper, horizon, announced)]
        answers = horizon[row]["answers"] if row in horizon else None
        counts = ""
        if answers is not None:
            counts = "; ".join(str(answers[one]) for one in ("impossible", "possible", "unknown"))
        rows.append([f"`{name}`", f"{path}, {speed:g} m/s", cells[0], cells[1], counts, cells[2]])
    titles = [title for title, _, _ in _BESIDE]
    answered = "of the missed: impossible; possible; not known"
    header = ["scenario", "leader", titles[0], titles[1], answered, titles[2]]
    return {"fast_leaders_beside": table(header, rows)}


def _measured(options: Sequence[str], runs: Dict[str, int], say: Say) -> Dict[Row, Dict]:
    """Summaries of the classes of a column."""
    found: Dict[Row, Dict] = {}
    for name, count in runs.items():
        for classes in _classes(name, options):
            words = ["--runs", str(count), *_COMMON, *classes, *options]
            for each in run_classes(name, words, say):
                ranges = each["ranges"]
                found[name, ranges["path"], ranges["speed"]] = each["summary"]
    return found


def _classes(name: str, options: Sequence[str]) -> Sequence[Sequence[str]]:
    if name == _ROD:
        return (("--speed", "0.2"),)
    if options == _FOREKNOWN:
        return (_FASTEST, _DIVES)
    # Behind a slow leader nothing is missed, announced or not.
    return (_FAST if options == _ANNOUNCED else _ALL, _DIVES)


def _cell(summary) -> str:
    if summary is None:
        return ""
    stuck = summary["stuck"]["runs"]
    return missed(summary) + (f"; {stuck} stuck" if stuck else "")
