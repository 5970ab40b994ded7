"""Tables and reports as text and files."""

import csv
import io
import json

import pytest

from deformable_manipulation.benchmarks.report import Report
from deformable_manipulation.benchmarks.table import EMPTY, Column, Table
from deformable_manipulation.markdown.block import BlockError, Provenance, read_blocks

COLUMNS = (Column("name", "library"), Column("time", "time [µs]", ".1f"), Column("n", "n", "d"))
BEGIN, END = "<!-- figures: benchmark_rod -->", "<!-- end -->"
ORIGIN = Provenance("scripts/benchmark rod", "a processor, 2 cores", "0123456789ab", "2026-01-31")


@pytest.fixture
def table():
    rows = [
        {"name": "this one", "time": 8.06, "n": 28, "extra": [1, 2]},
        {"name": "other | one", "time": None},
    ]
    return Table("substep", "One substep", COLUMNS, rows, ["in one thread"])


@pytest.fixture
def report(table):
    return Report("rod", [table], {"processor": "a processor", "cores": "2"})


def test_markdown(table):
    assert table.markdown().splitlines() == [
        "**One substep**",
        "",
        "| library | time [µs] | n |",
        "|---|---:|---:|",
        "| this one | 8.1 | 28 |",
        f"| other \\| one | {EMPTY} | {EMPTY} |",
        "",
        "- in one thread",
    ]


def test_csv_has_the_numbers_in_full(table):
    rows = list(csv.DictReader(io.StringIO(table.csv())))
    assert rows[0] == {"name": "this one", "time": "8.06", "n": "28"}
    assert rows[1] == {"name": "other | one", "time": "", "n": ""}


def test_a_terminal_gets_columns(table):
    lines = table.terminal().splitlines()
    assert lines[:2] == ["One substep", ""]
    assert lines[2] == "library      time [µs]   n"
    assert lines[4] == "this one           8.1  28"
    assert lines[5].split() == ["other", "|", "one", EMPTY, EMPTY]
    assert lines[6] == "  in one thread"


@pytest.mark.parametrize("value", [None, float("nan"), float("inf")])
def test_what_is_not_a_number_is_no_number(value):
    assert COLUMNS[1].text({"time": value}) == EMPTY
    assert COLUMNS[1].text({}) == EMPTY


def test_files(report, tmp_path):
    folder = tmp_path / "new" / "results"
    paths = report.write(folder)
    assert sorted(path.name for path in paths) == ["rod.json", "rod.md", "rod_substep.csv"]
    data = json.loads((folder / "rod.json").read_text())
    assert data["machine"]["processor"] == "a processor"
    assert data["tables"]["substep"]["rows"][0]["extra"] == [1, 2]
    markdown = (folder / "rod.md").read_text()
    assert "| this one | 8.1 | 28 |" in markdown and "| processor | a processor |" in markdown


def test_a_section_of_a_document_is_replaced_and_nothing_else(report, tmp_path):
    document = tmp_path / "page.md"
    document.write_text(f"# Page\n\n{BEGIN}\nold table\n{END}\n\nlast words\n")
    report.update(document, ORIGIN)
    once = document.read_text()
    assert once.startswith("# Page\n\n<!-- figures: benchmark_rod (scripts/benchmark rod; ")
    assert once.endswith(f"{END}\n\nlast words\n")
    assert "old table" not in once and report.markdown() in once
    assert read_blocks(document)[0].provenance == ORIGIN
    report.update(document, ORIGIN)
    assert document.read_text() == once


@pytest.mark.parametrize(
    "text", ["", BEGIN, END, f"{END}\n{BEGIN}", f"{BEGIN}\n{BEGIN}\n{END}", f"{BEGIN}{END}{END}"]
)
def test_a_document_without_a_place_stays_as_it_is(report, tmp_path, text):
    document = tmp_path / "page.md"
    document.write_text(text)
    with pytest.raises(BlockError, match="page.md"):
        report.update(document, ORIGIN)
    assert document.read_text() == text
