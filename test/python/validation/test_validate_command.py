"""The page of the validation, and the command that writes it."""

import math

import pytest

from deformable_manipulation.commands import validate
from deformable_manipulation.markdown.block import Provenance
from deformable_manipulation.validation import cases
from deformable_manipulation.validation.figures import draw
from deformable_manipulation.validation.report import report
from deformable_manipulation.validation.result import (
    CaseResult,
    Curve,
    Panel,
    error_check,
    ratio_check,
    refined,
    relative_check,
)

ORIGIN = Provenance("scripts/validate", "a processor, 2 cores", "0123456789ab", "2026-01-31")


def case(*checks, **options):
    return CaseResult("A case", "How it was done.", list(checks), **options)


GOOD = relative_check("drop, 28 segments", 2.0, 2.01, "m", 1.0)
NEARER = relative_check("drop, 45 segments", 2.0, 2.018, "m", 1.0)
BAD = error_check("deviation", 0.3, "%", 0.2)
PANEL = Panel(
    "errors", "x [m]", "%", [Curve("t", [1, 2], [1, 2], theory=True), Curve("s", [1], [1])]
)


class TestCheck:
    def test_errors(self):
        assert GOOD.error == pytest.approx(0.5)
        assert ratio_check("", 0.2, 0.3, "%", 1.2).error == pytest.approx(1.5)
        assert BAD.error == 0.3

    def test_passes_up_to_the_tolerance(self):
        assert GOOD.passed and not BAD.passed
        assert error_check("", 0.2, "%", 0.2).passed

    @pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
    def test_numbers_that_are_not_finite_never_pass(self, value):
        assert not error_check("", value, "m", 1.0).passed
        assert not relative_check("", 1.0, value, "m", 1.0).passed
        assert not ratio_check("", 1.0, value, "m", 1.0).passed

    def test_refined_tolerance_is_of_second_order(self):
        assert refined(0.4, 28) == 0.4
        assert refined(0.4, 56) == pytest.approx(1.2 * 0.1)


class TestReport:
    def test_summary_has_the_worst_of_each_kind(self):
        page = report({"one": case(GOOD, NEARER)}, {}, ORIGIN)
        summary = page.split("## A case")[0]
        assert "All 2 comparisons are within" in summary
        assert (
            "| **one**: drop, 45 segments (of 2) | 2 m | 2.018 m | 0.9 % | 1 % | yes |" in summary
        )
        assert "28 segments" not in summary
        assert "| drop, 28 segments |" in page

    def test_tells_what_misses(self):
        page = report({"one": case(GOOD, BAD)}, {"one": "images/one.png"}, ORIGIN)
        assert "**1 of 2 comparisons miss" in page
        assert "| deviation |  | 0.3 % | 0.3 % | 0.2 % | **no** |" in page
        assert "![A case](images/one.png)" in page


class TestCommand:
    @pytest.fixture(autouse=True)
    def run_in_temporary_folder(self, tmp_path, monkeypatch):
        monkeypatch.chdir(tmp_path)

    def use(self, monkeypatch, **functions):
        for name, function in functions.items():
            monkeypatch.setitem(cases.CASES, name, function)

    def test_names_are_those_of_the_cases(self):
        assert tuple(cases.CASES) == validate.CASE_NAMES

    def test_writes_page_and_figure(self, tmp_path, monkeypatch, capsys):
        self.use(monkeypatch, free=lambda quick: case(GOOD, panels=[PANEL]))
        assert validate.main(["--case", "free", "--output", "out"]) == 0
        assert "drop, 28 segments" in (tmp_path / "out/validation.md").read_text()
        image = tmp_path / "out/images/validation_free.png"
        assert image.read_bytes()[:4] == b"\x89PNG"
        output = capsys.readouterr()
        assert "out/validation.md" in output.out
        assert "1 of 1 passed" in output.err

    def test_part_of_the_cases_does_not_replace_the_documentation(self, tmp_path, monkeypatch):
        self.use(monkeypatch, free=lambda quick: case(GOOD))
        assert validate.main(["--case", "free", "--quick"]) == 0
        assert (tmp_path / "output/validation/validation.md").is_file()
        assert not (tmp_path / "docs").exists()

    def test_fails_where_a_case_misses(self, monkeypatch, capsys):
        self.use(monkeypatch, free=lambda quick: case(GOOD, BAD))
        assert validate.main(["--case", "free"]) == 1
        assert "missed: deviation: 0.3 %, tolerance 0.2 %" in capsys.readouterr().err

    def test_fails_where_a_case_cannot_be_run(self, monkeypatch, capsys):
        def restless(quick):
            raise RuntimeError("the rod still moves")

        self.use(monkeypatch, free=restless)
        assert validate.main(["--case", "free"]) == 1
        assert "could not be run: the rod still moves" in capsys.readouterr().err

    def test_hands_quick_to_the_case(self, monkeypatch):
        given = []
        self.use(monkeypatch, free=lambda quick: given.append(quick) or case(GOOD))
        validate.main(["--case", "free", "--quick"])
        validate.main(["--case", "free"])
        assert given == [True, False]

    def test_says_where_it_cannot_write(self, tmp_path, monkeypatch, capsys):
        self.use(monkeypatch, free=lambda quick: case(GOOD))
        (tmp_path / "file").touch()
        assert validate.main(["--case", "free", "--output", "file"]) == 1
        assert "cannot write" in capsys.readouterr().err

    def test_refuses_unknown_cases(self, capsys):
        with pytest.raises(SystemExit) as stop:
            validate.main(["--case", "fabric"])
        assert stop.value.code == 2
        assert "hanging" in capsys.readouterr().err


def test_a_figure_has_a_panel_each():
    figure = draw(case(GOOD, panels=[PANEL, PANEL, PANEL]))
    assert len(figure.axes) == 3
    assert [line.get_label() for line in figure.axes[0].get_lines()] == ["t", "s"]
