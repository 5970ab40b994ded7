"""The command as it is called, with short measurements; no speed is tested."""

import contextlib
import csv
import io
import json
import math
import shutil
from pathlib import Path

import pytest

from deformable_manipulation.benchmarks.machine import BUSY, describe_machine, load_warning
from deformable_manipulation.benchmarks.rivals.catalogue import FABRIC_RIVALS, ROD_RIVALS
from deformable_manipulation.benchmarks.subject import SUBJECTS
from deformable_manipulation.commands.benchmark import main

DOCUMENT = Path(__file__).parents[3] / "docs" / "benchmarks.md"


class Run:
    """What a run of a subject left, without the other libraries."""

    def __init__(self, subject, folder):
        self.output = folder / "results"
        self.document = folder / "benchmarks.md"
        shutil.copy(DOCUMENT, self.document)
        arguments = [subject, "--quick", "--rivals", str(folder / "nowhere")]
        arguments += ["--output", str(self.output), "--update-docs", str(self.document)]
        shown, said = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(shown), contextlib.redirect_stderr(said):
            self.status = main(arguments)
        self.shown, self.said = shown.getvalue(), said.getvalue()
        file = self.output / f"{subject}.json"
        self.data = json.loads(file.read_text(encoding="utf-8"))

    def rows(self, table):
        return self.data["tables"][table]["rows"]


def require_no_numbers_of_missing_libraries(run, rivals):
    rows = run.rows("comparison")
    missing = [row for row in rows if row["library"] != "this package"]
    assert len(missing) == len(rivals)
    for row in missing:
        assert "not installed: benchmark --install-rivals" in row["remark"]
        assert not any(isinstance(value, float) for value in row.values())
    own = [row for row in rows if row["library"] == "this package"]
    assert own and all(abs(row["error_percent"]) < 0.1 for row in own)


@pytest.fixture(scope="module")
def rod_run(tmp_path_factory):
    return Run("rod", tmp_path_factory.mktemp("rod"))


def test_rod_measures_every_combination(rod_run):
    assert rod_run.status == 0
    assert {(row["solver"], row["copies"]) for row in rod_run.rows("substep")} == {
        (solver, copies) for solver in ("direct", "gauss_seidel") for copies in (1, 4, 8, 13)
    }
    assert {row["copies"] for row in rod_run.rows("equilibrium")} == {1, 7}
    for name in ("substep", "equilibrium"):
        for row in rod_run.rows(name):
            assert 0.0 < row["minimum_us"] <= row["median_us"] < math.inf
    assert "One substep" in rod_run.shown and str(rod_run.output / "rod.json") in rod_run.shown
    assert "direct, 28 segments, 8 copies" in rod_run.said


def test_rod_writes_what_it_measured(rod_run):
    machine = rod_run.data["machine"]
    assert machine["processor"] and machine["compiler"] != "unknown"
    with open(rod_run.output / "rod_substep.csv", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert [float(row["median_us"]) for row in rows] == [
        row["median_us"] for row in rod_run.rows("substep")
    ]
    markdown = (rod_run.output / "rod.md").read_text(encoding="utf-8")
    assert markdown in rod_run.document.read_text(encoding="utf-8")


def test_libraries_that_are_not_installed_have_no_numbers(rod_run):
    require_no_numbers_of_missing_libraries(rod_run, ROD_RIVALS)


def test_fabric_measures_every_combination_and_its_memory(tmp_path):
    run = Run("fabric", tmp_path)
    assert run.status == 0
    rows = run.rows("substep")
    assert {(row["particles"], row["copies"]) for row in rows} == {
        (particles, copies) for particles in ("8x8", "15x15") for copies in (1, 4, 8, 13, 19)
    }
    for row in rows:
        assert 0.0 < row["minimum_us"] <= row["median_us"] < math.inf
    memory = {row["copies"]: row["memory"] for row in rows if row["particles"] == "15x15"}
    if not math.isnan(memory[1]):
        # Positions, those before and velocities of eight copies are the least.
        assert 3 * 225 * 3 * 8 * 8e-6 < memory[8] < memory[13] < memory[19] < 2.0
    assert run.data["machine"]["chosen instruction set"] in "\n".join(
        run.data["tables"]["substep"]["notes"]
    )
    require_no_numbers_of_missing_libraries(run, FABRIC_RIVALS)


def test_qp_end_to_end(tmp_path, capsys):
    assert main(["qp", "--quick", "--output", str(tmp_path)]) == 0
    rows = json.loads((tmp_path / "qp.json").read_text())["tables"]["latency"]["rows"]
    solved = {(row["problems"], row["solver"]): row["solved"] for row in rows}
    for problems in ("feasible", "infeasible"):
        assert solved[problems, "safety filter"] == solved[problems, "quadprog, soft"] == 100.0
    assert solved["infeasible", "quadprog, hard"] == solved["infeasible", "qpsolvers, hard"] == 0.0
    assert all(row["minimum_us"] <= row["median_us"] <= row["p99_us"] for row in rows)
    assert "safety filter" in capsys.readouterr().out


def test_cycle_end_to_end(tmp_path):
    assert main(["cycle", "--quick", "--output", str(tmp_path)]) == 0
    rows = json.loads((tmp_path / "cycle.json").read_text())["tables"]["parts"]["rows"]
    times = {(row["formulation"], row["part"]): row["median_us"] for row in rows}
    for formulation in ("full", "paper"):
        assert 0.0 < times[formulation, "controller"] < times[formulation, "whole cycle"]


def test_the_page_has_a_place_for_every_subject():
    text = DOCUMENT.read_text(encoding="utf-8")
    for subject in SUBJECTS:
        assert text.count(f"<!-- figures: benchmark_{subject} ") == 1


def test_a_page_without_a_place_is_an_error(tmp_path, capsys):
    page = tmp_path / "page.md"
    page.write_text("# Page\n")
    assert main(["qp", "--quick", "--update-docs", str(page)]) == 1
    assert "figures: benchmark_qp" in capsys.readouterr().err
    assert page.read_text() == "# Page\n"


def test_results_that_cannot_be_written_are_an_error(tmp_path, capsys):
    file = tmp_path / "file"
    file.write_text("")
    assert main(["qp", "--quick", "--output", str(file)]) == 1
    assert "cannot write" in capsys.readouterr().err


@pytest.mark.parametrize("wrong", [[], ["cloth"], ["rod", "--fast"], ["--quick"]])
def test_wrong_usage(wrong, capsys):
    with pytest.raises(SystemExit) as exit:
        main(wrong)
    assert exit.value.code == 2
    assert "usage: benchmark" in capsys.readouterr().err


def test_help_tells_the_subjects(capsys):
    with pytest.raises(SystemExit) as exit:
        main(["--help"])
    assert exit.value.code == 0
    shown = capsys.readouterr().out
    assert all(subject in shown for subject in SUBJECTS) and "exit status" in shown


def test_the_machine_is_described():
    described = describe_machine(["numpy"])
    assert all(described[key] for key in ("processor", "cores", "system", "compiler", "numpy"))
    assert float(described["load before"]) >= 0.0


def test_a_busy_machine_is_warned_about():
    assert load_warning(0.0) == ""
    assert "3.20" in load_warning(3.2) and load_warning(BUSY)


def test_loop_measures_a_run_in_real_time(tmp_path, monkeypatch):
    monkeypatch.setattr("deformable_manipulation.benchmarks.loop.SECONDS", {True: 2.0})
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        assert main(["loop", "--quick", "--output", str(tmp_path)]) == 0
    tables = json.loads((tmp_path / "loop.json").read_text(encoding="utf-8"))["tables"]
    (latency,) = tables["latency"]["rows"]
    assert latency["assistant"] == "assistant_1" and latency["rate"] > 0.0
    assert 0.0 < latency["median_ms"] <= latency["p99_ms"] <= latency["maximum_ms"]
    nodes = {row["node"]: row for row in tables["load"]["rows"]}
    assert set(nodes) == {"simulator", "leader", "assistants", "all"}
    assert min(row["memory"] for row in nodes.values()) > 1.0
    assert all(row["overruns"] >= 0 for row in nodes.values())
    assert all(nodes[name]["skipped"] >= 0 for name in ("leader", "assistants"))
    assert latency["status"] == "nominal"
