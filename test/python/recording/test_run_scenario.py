"""run_scenario around a closed loop that only replays synthetic cycles."""

import json
import os
import signal
import sys
import types

import pytest
from synthetic_run import make_record, make_scenario

from deformable_manipulation.commands.run_scenario import main
from deformable_manipulation.recording import read_run
from deformable_manipulation.scenario import scenario_to_yaml

CYCLES = 40


class ReplayLoop:
    """Stands in for ClosedLoop: records synthetic cycles, then does what a test wants."""

    end = None
    start = 1.0
    rest, warnings = "stable", ()
    runs = []

    def __init__(self, scenario, safety=True):
        self._scenario = scenario
        self.runs.append((scenario, safety))

    def distance(self):
        return self.start

    def run(self, recorder, progress):
        for cycle in range(CYCLES):
            recorder.record(make_record(self._scenario, cycle))
            progress((cycle + 1) / CYCLES)
        if self.end is not None:
            self.end()


@pytest.fixture
def loop(monkeypatch):
    module = types.ModuleType("deformable_manipulation.running.closed_loop")
    module.ClosedLoop = type("Loop", (ReplayLoop,), {"runs": []})
    monkeypatch.setitem(sys.modules, module.__name__, module)
    return module.ClosedLoop


@pytest.fixture
def scenario_file(tmp_path):
    path = tmp_path / "synthetic.yaml"
    path.write_text(scenario_to_yaml(make_scenario(tmp_path)))
    return str(path)


@pytest.fixture
def output(tmp_path):
    return tmp_path / "run"


def read_summary(folder):
    return json.loads((folder / "summary.json").read_text())


def test_a_whole_run(loop, scenario_file, output, capsys):
    assert main([scenario_file, "--output", str(output)]) == 0
    summary = read_summary(output)
    assert summary["completed"] and summary["safety"]
    assert summary["cycles"] == CYCLES == len(read_run(output).time)
    assert summary["wall_time"] > 0
    captured = capsys.readouterr()
    assert f"written to {output}" in captured.out
    assert "lowest distance            60.0 mm (offset 50.0 mm)" in captured.out
    assert captured.err.split("\n")[-2] == "100 %"


def test_default_folder_tells_scenario_and_time(loop, scenario_file, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main([scenario_file]) == 0
    (folder,) = (tmp_path / "output").iterdir()
    assert folder.name.startswith("synthetic_2")
    assert len(folder.name) == len("synthetic_YYYYmmdd_HHMMSS")


def test_options_reach_the_loop_and_the_summary(loop, scenario_file, output):
    options = ["--no-safety", "--set", "controller.gain=2.5", "--set", "simulation.duration=3"]
    assert main([scenario_file, "--output", str(output), *options]) == 0
    ((scenario, safety),) = loop.runs
    assert (scenario.controller.gain, scenario.simulation.duration, safety) == (2.5, 3.0, False)
    assert read_summary(output)["safety"] is False


def test_mistakes_of_the_scenario_are_told_and_nothing_is_written(
    loop, scenario_file, output, capsys
):
    options = ["--set", "controller.gain=-1", "--set", "simulation.duration=never"]
    assert main([scenario_file, "--output", str(output), *options]) == 1
    error = capsys.readouterr().err
    assert "controller.gain" in error and "simulation.duration" in error
    assert not output.exists() and not loop.runs


@pytest.mark.parametrize("error", [ValueError, RuntimeError])
def test_a_scenario_that_cannot_be_simulated_leaves_nothing(
    loop, scenario_file, output, capsys, error
):
    def refuse(self, scenario, safety):
        raise error("young_modulus: 1e99")

    loop.__init__ = refuse
    assert main([scenario_file, "--output", str(output)]) == 1
    assert "cannot be simulated: young_modulus: 1e99" in capsys.readouterr().err
    assert not output.exists()


@pytest.mark.parametrize("text", ["controller.gain", "=3"])
def test_a_malformed_set_is_wrong_usage(loop, scenario_file, text, capsys):
    with pytest.raises(SystemExit) as stop:
        main([scenario_file, "--set", text])
    assert stop.value.code == 2


def test_an_earlier_run_is_overwritten_only_by_force(loop, scenario_file, output, capsys):
    assert main([scenario_file, "--output", str(output)]) == 0
    assert main([scenario_file, "--output", str(output), "--no-safety"]) == 1
    assert "already contains a run" in capsys.readouterr().err
    assert read_summary(output)["safety"]
    assert main([scenario_file, "--output", str(output), "--no-safety", "--force"]) == 0
    assert not read_summary(output)["safety"]


@pytest.mark.parametrize("number, code", [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_an_interrupted_run_keeps_its_data(loop, scenario_file, output, capsys, number, code):
    before = signal.getsignal(number)
    loop.end = staticmethod(lambda: os.kill(os.getpid(), number))
    assert main([scenario_file, "--output", str(output)]) == code
    assert not read_summary(output)["completed"]
    assert len(read_run(output).time) == CYCLES
    out = capsys.readouterr().out
    assert "stopped early" in out and str(output) in out
    assert signal.getsignal(number) == before


def test_a_second_interrupt_does_not_lose_what_is_being_written(
    loop, scenario_file, output, monkeypatch
):
    from deformable_manipulation.recording import run_recorder

    def write_while_impatient(summary, file):
        os.kill(os.getpid(), signal.SIGINT)
        file.write("{}")

    monkeypatch.setattr(run_recorder, "write_summary", write_while_impatient)
    loop.end = staticmethod(lambda: os.kill(os.getpid(), signal.SIGINT))
    assert main([scenario_file, "--output", str(output)]) == 130
    assert read_summary(output) == {}


def test_a_failing_simulation_keeps_its_data_and_tells_why(loop, scenario_file, output, capsys):
    def fail():
        raise RuntimeError("state of particle 3 is not finite")

    loop.end = staticmethod(fail)
    assert main([scenario_file, "--output", str(output)]) == 1
    assert "state of particle 3 is not finite" in capsys.readouterr().err
    assert read_summary(output)["cycles"] == CYCLES


def test_data_survives_a_mistake_in_the_program(loop, scenario_file, output):
    loop.end = staticmethod(lambda: {}["missing"])
    with pytest.raises(KeyError):
        main([scenario_file, "--output", str(output)])
    assert len(read_run(output).time) == CYCLES


def test_failing_to_write_is_no_success(loop, scenario_file, output, monkeypatch, capsys):
    from deformable_manipulation.recording import run_recorder

    def full_disk(*arguments, **keywords):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(run_recorder.np, "savez_compressed", full_disk)
    assert main([scenario_file, "--output", str(output)]) == 1
    assert "No space left" in capsys.readouterr().err


def test_a_start_that_is_no_stable_rest_is_told(loop, scenario_file, output, capsys):
    loop.rest, loop.warnings = "balanced", ("It may fall over.",)
    assert main([scenario_file, "--output", str(output)]) == 0
    printed = capsys.readouterr()
    assert "WARNING: It may fall over." in printed.err
    assert "WARNING: the object started in an unstable balance" in printed.out
    assert json.loads((output / "summary.json").read_text())["start"] == "balanced"


@pytest.mark.parametrize("start, warned", [(1.0, False), (0.01, True), (-0.1, True)])
def test_a_start_within_the_offset_is_told(loop, scenario_file, output, capsys, start, warned):
    loop.start = start
    assert main([scenario_file, "--output", str(output)]) == 0
    assert (f"starts {1e3 * start:.1f} mm from the obstacles" in capsys.readouterr().err) == warned
