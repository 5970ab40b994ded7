"""Tables in Markdown."""

from typing import Iterable, Optional, Sequence


def table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table; every row has as many cells as the header."""
    return "\n".join([_row(header), "|" + "---|" * len(header), *map(_row, rows)])


def millimetres(metres: Optional[float], digits: int = 1) -> str:
    """A length in mm, without the unit; empty if there is none."""
    if metres is None:
        return ""
    text = f"{1e3 * metres:.{digits}f}"
    return text.lstrip("-") if float(text) == 0.0 else text


def _row(cells: Sequence[str]) -> str:
    return "|" + "".join(f" {cell} |" if cell else " |" for cell in cells)
