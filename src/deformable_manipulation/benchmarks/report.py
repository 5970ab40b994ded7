"""The result of a benchmark: tables and machine, as files and as a section of the documentation."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Dict, List, Sequence

from deformable_manipulation.benchmarks.table import Table
from deformable_manipulation.markdown.block import Provenance, write_block


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

    def update(self, document: Path, provenance: Provenance) -> None:
        """Replace the subject's block of a document.

        Raises:
            BlockError: the document has no such block, or is not well-formed.
            OSError: it cannot be read or written.
        """
        write_block(document, f"benchmark_{self.subject}", self.markdown(), provenance)
