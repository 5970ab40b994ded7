"""The result of a benchmark: tables and machine, as files and as a section of the documentation."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Dict, List, Sequence

from deformable_manipulation.benchmarks.table import Table


class DocumentError(ValueError):
    """A document has no place for the section."""


@dataclass
class Report:
    """All tables of a subject, measured together."""

    subject: str
    tables: Sequence[Table]
    machine: Dict[str, str]

    def markdown(self) -> str:
        """Tables and machine in Markdown."""
        lines = ["| measured on | |", "|---|---|"]
        lines += [f"| {name} | {value} |" for name, value in self.machine.items()]
        return "\n".join([table.markdown() for table in self.tables] + ["\n".join(lines) + "\n"])

    def json(self) -> str:
        """Everything that was measured, with the keys of the rows."""
        tables = {
            table.name: {"title": table.title, "rows": table.rows, "notes": table.notes}
            for table in self.tables
        }
        result = {"subject": self.subject, "machine": self.machine, "tables": tables}
        return json.dumps(result, indent=2, ensure_ascii=False) + "\n"

    def write(self, folder: Path) -> List[Path]:
        """Write JSON, Markdown and a CSV per table; returns their paths. Raises OSError."""
        texts = {f"{self.subject}.json": self.json(), f"{self.subject}.md": self.markdown()}
        texts.update({f"{self.subject}_{table.name}.csv": table.csv() for table in self.tables})
        folder.mkdir(parents=True, exist_ok=True)
        for name, text in texts.items():
            (folder / name).write_text(text, encoding="utf-8")
        return [folder / name for name in texts]

    def update(self, document: Path) -> None:
        """Replace the subject's section of a document, which stands between two markers.

        Raises:
            DocumentError: the markers are not there in this order, once each.
            OSError: the document cannot be read or written.
        """
        text = document.read_text(encoding="utf-8")
        begin, end = (f"<!-- benchmark {self.subject}: {place} -->" for place in ("begin", "end"))
        start, stop = text.find(begin), text.find(end)
        if text.count(begin) != 1 or text.count(end) != 1 or stop < start:
            raise DocumentError(f"{document}: needs the lines {begin} and {end}, once each")
        head, tail = text[: start + len(begin)], text[stop:]
        document.write_text(f"{head}\n\n{self.markdown()}\n{tail}", encoding="utf-8")
