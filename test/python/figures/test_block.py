"""Blocks of measured numbers in a page."""

import pytest

from deformable_manipulation.markdown.block import (
    BlockError,
    Provenance,
    read_blocks,
    render_block,
    write_block,
)

ORIGIN = Provenance("run it --set a=1", "a processor, 2 cores", "0123456789ab", "2026-01-31")
EMPTY = "# Page\n\n<!-- figures: one -->\n<!-- end -->\n\nlast words\n"
TABLE = "| a |\n|---|\n| 1 |"


@pytest.fixture
def page(tmp_path):
    path = tmp_path / "page.md"
    path.write_text(EMPTY)
    return path


def test_a_new_block_was_never_measured(page):
    (block,) = read_blocks(page)
    assert (block.name, block.content, block.provenance) == ("one", "", None)
    assert not block.edited


def test_what_is_written_is_read(page):
    write_block(page, "one", TABLE, ORIGIN)
    (block,) = read_blocks(page)
    assert (block.content, block.provenance, block.edited) == (TABLE, ORIGIN, False)
    text = page.read_text()
    assert text.startswith("# Page\n\n<!--") and text.endswith("<!-- end -->\n\nlast words\n")
    assert "on 2026-01-31 at commit 0123456 (a processor, 2 cores): `run it --set a=1`" in text
    assert render_block("one", TABLE, ORIGIN) in text


def test_writing_again_changes_nothing(page):
    write_block(page, "one", TABLE, ORIGIN)
    once = page.read_text()
    write_block(page, "one", read_blocks(page)[0].content, ORIGIN)
    assert page.read_text() == once


@pytest.mark.parametrize("old, new", [("| 1 |", "| 2 |"), ("2 cores): ", "8 cores): ")])
def test_an_edit_shows(page, old, new):
    write_block(page, "one", TABLE, ORIGIN)
    page.write_text(page.read_text().replace(old, new))
    assert read_blocks(page)[0].edited


@pytest.mark.parametrize(
    "text, message",
    [
        ("<!-- figures: one -->\n", "no <!-- end -->"),
        ("<!-- end -->\n", "without a beginning"),
        ("<!-- figures: one (by hand) -->\n<!-- end -->\n", "malformed"),
        ("<!-- figures: one -->\n<!-- figures: two -->\n<!-- end -->\n", "one has no"),
        (2 * "<!-- figures: one -->\n<!-- end -->\n", "twice"),
    ],
)
def test_malformed_pages_are_refused(page, text, message):
    page.write_text(text)
    with pytest.raises(BlockError, match=message):
        read_blocks(page)


def test_a_page_without_the_block_stays_as_it_is(page):
    with pytest.raises(BlockError, match="figures: two"):
        write_block(page, "two", TABLE, ORIGIN)
    assert page.read_text() == EMPTY


def test_an_origin_that_does_not_fit_is_refused(page):
    with pytest.raises(BlockError, match="does not fit"):
        write_block(page, "one", TABLE, Provenance("a; b", "c", "0123456789ab", "2026-01-31"))
    assert page.read_text() == EMPTY
