import json
import os
import shutil

import numpy as np
import pytest
from bag_writing import BagWriter
from synthetic_run import OFFSET, make_decision, make_record, make_scenario

from deformable_manipulation.commands.plot_run import main
from deformable_manipulation.plots.style import title_of
from deformable_manipulation.recording import RunDataError, RunRecorder, read_run
from deformable_manipulation.recording.summary import describe


@pytest.fixture
def run_folder(tmp_path):
    folder = tmp_path / "trial"
    scenario = make_scenario(tmp_path, assistants=2)
    recorder = RunRecorder(scenario, folder)
    for cycle in range(20):
        recorder.record(make_record(scenario, cycle))
    recorder.finish(1.0, True)
    return folder


def test_a_run_folder_gives_what_was_recorded(run_folder):
    run = read_run(run_folder)
    assert run.name == "trial"
    assert run.offset == pytest.approx(OFFSET)
    assert [series.agent for series in run.assistants] == ["assistant_1", "assistant_2"]
    for phase, series in enumerate(run.assistants):
        decisions = [make_decision(cycle, phase) for cycle in range(20)]
        for name in ("collision", "overstretch", "proximity"):
            expected = [decision.h[name] for decision in decisions]
            np.testing.assert_allclose(series.h[name], expected, rtol=1e-11)
        for name in "error_norm command status".split():
            expected = [getattr(decision, name) for decision in decisions]
            np.testing.assert_allclose(getattr(series, name), expected, rtol=1e-11)
        expected = [decision.nominal for decision in decisions]
        np.testing.assert_allclose(series.nominal_velocity, expected, rtol=1e-11)


def test_folder_and_bag_of_the_same_run_agree(run_folder, tmp_path):
    with BagWriter(tmp_path / "run.bag") as writer:
        for cycle in range(20):
            writer.cycle(cycle)
    folder, bag = read_run(run_folder), read_run(tmp_path / "run.bag")
    np.testing.assert_allclose(bag.time, folder.time, atol=1e-9)
    np.testing.assert_allclose(bag.distance, folder.distance, rtol=1e-11)
    assert bag.offset == pytest.approx(folder.offset)
    for name, h in folder.assistants[0].h.items():
        np.testing.assert_allclose(bag.assistants[0].h[name], h, rtol=1e-11)
    for name in "error_norm nominal_velocity command".split():
        in_bag, in_folder = getattr(bag.assistants[0], name), getattr(folder.assistants[0], name)
        np.testing.assert_allclose(in_bag, in_folder, rtol=1e-11)


def test_figures_are_written_beside_the_run_and_named(run_folder, capsys):
    assert main([str(run_folder)]) == 0
    names = ("controller_assistant_1", "controller_assistant_2", "overview")
    figures = [run_folder / f"{name}{ending}" for name in names for ending in (".png", ".pdf")]
    assert capsys.readouterr().out.split() == [str(path) for path in figures]
    magic = {".png": b"\x89PNG", ".pdf": b"%PDF"}
    assert all(path.read_bytes().startswith(magic[path.suffix]) for path in figures)


def test_figures_of_a_bag_carry_its_name(tmp_path, capsys):
    (tmp_path / "bags").mkdir()
    with BagWriter(tmp_path / "bags" / "monday.bag") as writer:
        writer.cycle(0)
        writer.cycle(0, reset_count=1)
    # The folder holds exactly one bag.
    output = tmp_path / "new" / "figures"
    assert main([str(tmp_path / "bags"), "--output", str(output)]) == 0
    captured = capsys.readouterr()
    names = ["monday_controller_assistant_1.png", "monday_controller_assistant_1.pdf"]
    assert captured.out.split() == [str(output / name) for name in names]
    assert all((output / name).exists() for name in names)
    assert "note: the bag holds 2 runs" in captured.err


@pytest.mark.parametrize(
    "damage, message",
    [
        (lambda text: "", "contains no cycle"),
        (lambda text: text.splitlines()[0] + "\n", "contains no cycle"),
        (lambda text: text[: text.rindex(",")], r"line 21: \d+ values for \d+ columns; .* cut off"),
        (lambda text: text.replace(".error_norm", ".e"), "lacks .* assistant_1.error_norm"),
        (lambda text: text.replace("time", "t", 1), "lacks the columns time"),
        (lambda text: text.replace("\n3,0.03,", "\n3,soon,"), "column time: .*'soon'"),
    ],
)
def test_damaged_time_series(run_folder, damage, message):
    path = run_folder / "timeseries.csv"
    path.write_text(damage(path.read_text()))
    with pytest.raises(RunDataError, match=message):
        read_run(run_folder)


def test_time_series_that_is_no_text(run_folder):
    (run_folder / "timeseries.csv").write_bytes(b"\xff\xfe\x00" * 50)
    with pytest.raises(RunDataError, match="timeseries.csv cannot be read"):
        read_run(run_folder)


def test_paths_that_hold_no_run(run_folder, tmp_path, capsys):
    assert main([str(tmp_path / "nowhere")]) == 1
    assert "nowhere does not exist" in capsys.readouterr().err
    assert main([str(tmp_path / ("a" * 300))]) == 1
    assert "does not exist" in capsys.readouterr().err
    assert main([str(run_folder / "summary.json")]) == 1
    assert "neither a run folder nor a bag" in capsys.readouterr().err
    (tmp_path / "empty").mkdir()
    assert main([str(tmp_path / "empty")]) == 1
    assert "holds neither timeseries.csv nor a bag" in capsys.readouterr().err


def test_a_folder_of_several_bags_needs_a_choice(tmp_path, capsys):
    for name in ("a.bag", "b.bag"):
        with BagWriter(tmp_path / name) as writer:
            writer.cycle(0)
    assert main([str(tmp_path)]) == 1
    assert "several bags; give one of them: a.bag, b.bag" in capsys.readouterr().err


def test_unknown_format_is_refused(run_folder, capsys):
    with pytest.raises(SystemExit) as stop:
        main([str(run_folder), "--format", "png,gif"])
    assert stop.value.code == 2
    assert "unknown format 'gif'; allowed: png, pdf, svg" in capsys.readouterr().err


def test_a_pipe_in_the_place_of_a_file_is_refused(run_folder, tmp_path, capsys):
    (run_folder / "states.npz").unlink()
    os.mkfifo(str(run_folder / "states.npz"))
    assert main([str(run_folder), "--format", "png"]) == 0
    assert "no overview" in (told := capsys.readouterr().err) and "not a regular file" in told
    os.mkfifo(str(tmp_path / "run.bag"))
    assert main([str(tmp_path / "run.bag")]) == 1
    assert "run.bag is not a regular file" in capsys.readouterr().err
    (run_folder / "summary.json").unlink()
    os.mkfifo(str(run_folder / "summary.json"))
    assert read_run(run_folder).scenario == "synthetic"


def test_figures_are_titled_by_the_scenario_whatever_the_folder_is_called(run_folder, tmp_path):
    run = read_run(run_folder)
    assert (run.name, title_of(run, "assistant_1")) == ("trial", "synthetic: assistant_1")
    (run_folder / "summary.json").unlink()  # as of a run that was killed
    assert title_of(read_run(run_folder)) == "synthetic"
    (run_folder / "scenario.yaml").unlink()
    assert title_of(read_run(run_folder)) == "trial"
    with BagWriter(tmp_path / "monday.bag") as writer:
        writer.cycle(0)
        writer.run_info(make_scenario(tmp_path))
    assert title_of(read_run(tmp_path / "monday.bag")) == "synthetic"


def test_an_output_that_cannot_be_written(run_folder, capsys):
    file = run_folder / "summary.json"
    assert main([str(run_folder), "--output", str(file)]) == 1
    assert "cannot write the figures" in capsys.readouterr().err


def test_windows_are_shown_on_request_only(run_folder, monkeypatch, capsys):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    pyplot.switch_backend("agg")
    assert main([str(run_folder)]) == 0
    assert not pyplot.get_fignums()
    assert main([str(run_folder), "--show"]) == 0
    assert len(pyplot.get_fignums()) == 3
    pyplot.close("all")
    assert "no display" in capsys.readouterr().err


def test_a_copy_of_the_folder_reads_the_same(run_folder, tmp_path):
    shutil.copytree(str(run_folder), str(tmp_path / "copy"))
    copy = read_run(tmp_path / "copy")
    assert copy.name == "copy"
    np.testing.assert_array_equal(copy.distance, read_run(run_folder).distance)


def test_times_after_the_end_are_refused(run_folder, capsys):
    assert main([str(run_folder), "--times", "500"]) == 1
    assert "500 s is after the end of the run" in capsys.readouterr().err


def test_the_numbers_are_those_of_the_summary(run_folder, capsys):
    assert main([str(run_folder), "--format", "png", "--numbers"]) == 0
    printed = capsys.readouterr().out.splitlines()
    expected = describe(json.loads((run_folder / "summary.json").read_text())).splitlines()
    assert printed[-len(expected) + 1 :] == expected[1:]
