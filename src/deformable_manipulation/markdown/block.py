"""Marked blocks of a Markdown page, whose content a command measured.

A block begins with ``<!-- figures: NAME (COMMAND; MACHINE; commit COMMIT; DATE; checksum SUM) -->``
and ends with ``<!-- end -->``. Its last line tells readers the same. A block that was never
measured has the name alone.
"""

import hashlib
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Dict, List, Optional

END = "<!-- end -->"
_BEGIN = re.compile(r"^<!-- figures: .*$", re.MULTILINE)
_MARKER = re.compile(
    r"<!-- figures: (?P<name>\w+)"
    r"(?: \((?P<command>[^;\n]+); (?P<machine>[^;\n]+); commit (?P<commit>[0-9a-f]{7,40}|unknown);"
    r" (?P<date>\d{4}-\d\d-\d\d); checksum (?P<checksum>[0-9a-f]{12})\))? -->"
)


class BlockError(ValueError):
    """A page's blocks are not well-formed, or a block is missing."""


@dataclass(frozen=True)
class Provenance:
    """Where numbers come from."""

    command: str
    machine: str
    commit: str  # of the code that was measured; "unknown" outside of a checkout
    date: str  # year-month-day


@dataclass(frozen=True)
class Block:
    """A block as it stands in a page."""

    name: str
    content: str  # without the line that tells its origin
    provenance: Optional[Provenance] = None  # None: never measured
    checksum: str = ""  # of the content, when it was written

    @property
    def edited(self) -> bool:
        """Whether the content has changed since a command wrote it."""
        return self.provenance is not None and self.checksum != checksum(self.content)


def checksum(content: str) -> str:
    """A short hash of a block's content."""
    return hashlib.sha256(content.strip().encode("utf-8")).hexdigest()[:12]


def read_blocks(page: Path) -> List[Block]:
    """Return the blocks of a page, in their order.

    Raises:
        BlockError: a marker is malformed, a block has no end, or a name comes twice.
        OSError: the page cannot be read.
    """
    return list(_find(page.read_text(encoding="utf-8"), page).values())


def write_block(page: Path, name: str, content: str, provenance: Provenance) -> None:
    """Replace the content of a block and say where it comes from.

    Raises:
        BlockError: the page has no such block, or is not well-formed.
        OSError: the page cannot be read or written.
    """
    text = page.read_text(encoding="utf-8")
    if name not in _find(text, page):
        raise BlockError(f"{page}: needs the lines <!-- figures: {name} --> and {END}")
    begin = re.search(rf"^<!-- figures: {name}\b.*$", text, re.MULTILINE)
    assert begin is not None  # it was found
    end = text.index(END, begin.end())
    after = text[end + len(END) :]
    block = render_block(name, content, provenance)
    page.write_text(text[: begin.start()] + block + after, encoding="utf-8")


def render_block(name: str, content: str, provenance: Provenance) -> str:
    """A whole block, for a page that is written anew."""
    content = content.strip()
    marker = _marker(name, content, provenance)
    return f"{marker}\n\n{content}\n\n{_origin(provenance)}\n\n{END}"


def _marker(name: str, content: str, provenance: Provenance) -> str:
    marker = (
        f"<!-- figures: {name} ({provenance.command}; {provenance.machine}; "
        f"commit {provenance.commit}; {provenance.date}; checksum {checksum(content)}) -->"
    )
    if not _MARKER.fullmatch(marker):
        raise BlockError(f"the origin of {name} does not fit into a marker: {provenance}")
    return marker


def _find(text: str, page: Path) -> Dict[str, Block]:
    blocks: Dict[str, Block] = {}
    begins = list(_BEGIN.finditer(text))
    limits = [begin.start() for begin in begins[1:]] + [len(text)]
    for begin, limit in zip(begins, limits):
        marker = _MARKER.fullmatch(begin.group())
        if marker is None:
            raise BlockError(f"{page}: malformed marker: {begin.group()}")
        name = marker["name"]
        end = text.find(END, begin.end(), limit)
        if end < 0:
            raise BlockError(f"{page}: block {name} has no {END}")
        if name in blocks:
            raise BlockError(f"{page}: block {name} comes twice")
        blocks[name] = _block(marker, text[begin.end() : end].strip())
    if text.count(END) != len(begins):
        raise BlockError(f"{page}: has an {END} without a beginning")
    return blocks


def _block(marker, content: str) -> Block:
    if marker["commit"] is None:
        return Block(marker["name"], content)
    fields = (marker[key] for key in ("command", "machine", "commit", "date"))
    provenance = Provenance(*fields)
    origin = _origin(provenance)
    if content.endswith(origin):
        content = content[: -len(origin)].strip()
    return Block(marker["name"], content, provenance, marker["checksum"])


def _origin(provenance: Provenance) -> str:
    return (
        f"<sub>Measured on {provenance.date} at commit {provenance.commit[:7]} "
        f"({provenance.machine}): `{provenance.command}`</sub>"
    )
