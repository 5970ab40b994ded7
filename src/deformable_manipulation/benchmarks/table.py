"""Tables of results, and how they are written."""

import csv
import io
import math
from dataclasses import dataclass, field
from typing import Any, Dict, List, Sequence

EMPTY = "–"


@dataclass(frozen=True)
class Column:
    """One column: key in the rows, heading with its unit, format of the numbers."""

    key: str
    heading: str
    form: str = ""  # of format(), for numbers; anything else is written as it is

    def text(self, row: Dict[str, Any]) -> str:
        """The cell of a row; a missing, empty or not finite value is shown as a dash."""
        value = row.get(self.key)
        if value is None or (isinstance(value, float) and not math.isfinite(value)):
            return EMPTY
        if isinstance(value, (int, float)) and not isinstance(value, bool):
            return format(value, self.form)
        return str(value)


@dataclass
class Table:
    """Rows of one kind; ``name`` is that of its files."""

    name: str
    title: str
    columns: Sequence[Column]
    rows: List[Dict[str, Any]] = field(default_factory=list)
    notes: List[str] = field(default_factory=list)

    def markdown(self) -> str:
        """The table in Markdown, with title and notes."""
        headings = [column.heading for column in self.columns]
        rules = ["---:" if self._is_number(column) else "---" for column in self.columns]
        lines = [_line(headings), "|" + "|".join(rules) + "|"]
        lines += [_line(cells) for cells in self._cells()]
        parts = ["**" + self.title + "**", "\n".join(lines)]
        if self.notes:
            parts.append("\n".join("- " + note for note in self.notes))
        return "\n\n".join(parts) + "\n"

    def csv(self) -> str:
        """The table as CSV: keys as the header, numbers in full."""
        stream = io.StringIO()
        keys = [column.key for column in self.columns]
        writer = csv.DictWriter(stream, keys, extrasaction="ignore", lineterminator="\n")
        writer.writeheader()
        writer.writerows(self.rows)
        return stream.getvalue()

    def terminal(self) -> str:
        """The table for a terminal, in columns of fixed width."""
        lines = [[column.heading for column in self.columns]] + self._cells()
        widths = [max(len(line[i]) for line in lines) for i in range(len(self.columns))]
        texts = ["  ".join(self._aligned(line, widths)).rstrip() for line in lines]
        texts.insert(1, "  ".join("-" * width for width in widths))
        return "\n".join([self.title, ""] + texts + ["  " + note for note in self.notes]) + "\n"

    def _cells(self) -> List[List[str]]:
        return [[column.text(row) for column in self.columns] for row in self.rows]

    def _is_number(self, column: Column) -> bool:
        return bool(column.form)

    def _aligned(self, line: Sequence[str], widths: Sequence[int]) -> List[str]:
        return [
            text.rjust(width) if self._is_number(column) else text.ljust(width)
            for text, width, column in zip(line, widths, self.columns)
        ]


def _line(cells: Sequence[str]) -> str:
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"
