"""The measured numbers in README.md and docs/."""

import re
import warnings
from pathlib import Path

import pytest

from deformable_manipulation.figures.excerpt import quote
from deformable_manipulation.figures.registry import PAGES, RESULTS, VALIDATION
from deformable_manipulation.figures.state import examine, read_pages
from deformable_manipulation.markdown.block import END, read_blocks

CHECKOUT = Path(__file__).parents[3]


def test_every_block_is_measured_unchanged_and_of_a_known_commit():
    findings = examine(CHECKOUT)
    assert [finding for finding in findings if finding.is_error] == []
    for finding in findings:
        warnings.warn(f"stale: {finding.name}: {finding.text}", stacklevel=1)


def test_the_excerpt_is_what_the_validation_page_says():
    blocks = {block.name: block for block in read_blocks(CHECKOUT / RESULTS)}
    assert blocks["validation_excerpt"].content == quote(CHECKOUT / VALIDATION)
    origin = read_pages(CHECKOUT)["validation"].provenance
    assert blocks["validation_excerpt"].provenance == origin


@pytest.mark.parametrize("page", PAGES)
def test_tables_outside_of_blocks_have_no_measured_numbers(page):
    text = (CHECKOUT / page).read_text(encoding="utf-8")
    outside = re.sub(rf"<!-- figures: .*?{END}", "", text, flags=re.DOTALL)
    cells = [
        cell.strip()
        for line in outside.splitlines()
        if line.startswith("|")
        for cell in line.strip("|").split("|")
    ]
    assert [cell for cell in cells if re.fullmatch(r"\*{0,2}-?[\d.]+( ?(m?m|m?s|%))?", cell)] == []
