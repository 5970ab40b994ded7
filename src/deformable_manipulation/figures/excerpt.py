"""Rows of the validation page that other pages quote."""

import re
from pathlib import Path
from typing import Dict, List

from deformable_manipulation.markdown.block import BlockError
from deformable_manipulation.markdown.table import table

QUANTITIES = (
    "largest deviation / L, pinned, level, 28 segments",
    "largest deviation / L, pinned, level, 100 segments",
    "tip drop, E 30 GPa, 28 segments",
    "tip drop, E 30 GPa, 100 segments",
    "sum of reactions, clamped, level, 28 segments",
    "critical twist, 28 segments",
    "critical twist, 100 segments",
    "extension of a hanging strip, 20 rows",
    "largest deviation / size, E t 10 kN/m, D 1 mN m, corners to 90 %",
    "weight, E t 1 kN/m, D 1 mN m, corners to 95 %",
    "change of shape when carried",
)
_VERDICT = re.compile(r"^(All \d+ comparisons are .*|\*\*\d+ of \d+ comparisons .*)$", re.MULTILINE)


def quote(page: Path) -> str:
    """Return the page's verdict on all comparisons and a table of some of them.

    Raises:
        BlockError: the page does not have one of them.
        OSError: it cannot be read.
    """
    text = page.read_text(encoding="utf-8")
    verdict = _VERDICT.search(text)
    rows = _rows(text)
    missing = [quantity for quantity in QUANTITIES if quantity not in rows]
    if verdict is None or missing:
        raise BlockError(f"{page}: lacks {missing or 'the number of comparisons'}")
    header = ["quantity", "theory", "measured", "error", "tolerance"]
    chosen = [[quantity, *rows[quantity][:4]] for quantity in QUANTITIES]
    return f"{verdict.group()}\n\n{table(header, chosen)}"


def _rows(text: str) -> Dict[str, List[str]]:
    lines = [line[2:].rstrip("| ").split(" | ") for line in text.splitlines() if line[:2] == "| "]
    return {cells[0].strip(): [cell.strip() for cell in cells[1:]] for cells in lines}
