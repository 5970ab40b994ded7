"""Which blocks are older than the code that they are about."""

from dataclasses import dataclass
from pathlib import Path
from typing import Dict, List, Sequence

from deformable_manipulation.figures.history import History
from deformable_manipulation.figures.registry import PAGES, SUBJECTS_BY_BLOCK, page_of
from deformable_manipulation.markdown.block import Block, BlockError, read_blocks


@dataclass(frozen=True)
class Finding:
    """What is wrong with a block: an error, or numbers of older code."""

    name: str
    text: str
    is_error: bool


def read_pages(checkout: Path) -> Dict[str, Block]:
    """Return all known blocks by name.

    Raises:
        BlockError: a page is malformed, has an unknown block, or lacks one.
        OSError: a page cannot be read.
    """
    found: Dict[str, Block] = {}
    for page in PAGES:
        for block in read_blocks(checkout / page):
            if block.name not in SUBJECTS_BY_BLOCK or page_of(block.name) != page:
                raise BlockError(f"{page}: unknown block {block.name}")
            found[block.name] = block
    missing = [name for name in SUBJECTS_BY_BLOCK if name not in found]
    if missing:
        raise BlockError(f"{page_of(missing[0])}: has no block {missing[0]}")
    return found


def examine(checkout: Path, names: Sequence[str] = ()) -> List[Finding]:
    """Return the findings about some blocks, without a name about all; measures nothing.

    Raises:
        BlockError: a page is malformed, has an unknown block, or lacks one.
        OSError: a page cannot be read.
        HistoryError: git refuses.
    """
    blocks = read_pages(checkout)
    history = History(checkout)
    findings: List[Finding] = []
    for name in names or SUBJECTS_BY_BLOCK:
        findings += _examine(blocks[name], history)
    return findings


def _examine(block: Block, history: History) -> List[Finding]:
    provenance = block.provenance
    if provenance is None:
        return [Finding(block.name, "was never measured", True)]
    if block.edited:
        return [Finding(block.name, "was edited by hand", True)]
    if not history.is_complete:
        return []
    if not history.has(provenance.commit):
        return [Finding(block.name, f"commit {provenance.commit} is not in the history", False)]
    change = history.change_since(provenance.commit, SUBJECTS_BY_BLOCK[block.name].sources)
    if change:
        text = f"measured at {provenance.commit} ({provenance.date}), code changed in {change}"
        return [Finding(block.name, text, False)]
    return []
