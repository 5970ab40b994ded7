import dataclasses
import json
import os

import numpy as np
import pytest
import yaml
from synthetic_run import OFFSET, POINTS, RATE, make_decision, make_record, make_scenario

from deformable_manipulation.control.status import Status
from deformable_manipulation.objects.fabric import FabricSpec
from deformable_manipulation.recording import (
    CycleTimings,
    RecordingError,
    RunRecorder,
    read_run,
)
from deformable_manipulation.recording import run_recorder as run_recorder_module
from deformable_manipulation.recording.summary import describe, describe_recorded
from deformable_manipulation.scenario import scenario_from_mapping


@pytest.fixture
def scenario(tmp_path):
    return make_scenario(tmp_path)


def record_run(scenario, folder, cycles, **changes):
    recorder = RunRecorder(scenario, folder)
    for cycle in range(cycles):
        recorder.record(make_record(scenario, cycle, **changes))
    return recorder


def read_table(folder):
    with open(folder / "timeseries.csv") as file:
        header = file.readline().strip().split(",")
    values = np.loadtxt(folder / "timeseries.csv", delimiter=",", skiprows=1, ndmin=2)
    return dict(zip(header, values.T))


def test_time_series_holds_every_recorded_number(tmp_path):
    scenario = make_scenario(tmp_path, assistants=2)
    record_run(scenario, tmp_path / "run", 30).finish(1.0, True)
    table = read_table(tmp_path / "run")
    for cycle in (0, 17, 29):
        record = make_record(scenario, cycle)
        row = {name: values[cycle] for name, values in table.items()}
        expected = {
            "cycle": cycle,
            "time": record.time,
            "distance": record.distance,
            "stretch": record.stretch,
        }
        for index, agent in enumerate(scenario.agents):
            expected.update(vector(f"{agent.name}.position", record.positions[index]))
            expected.update(vector(f"{agent.name}.velocity", record.velocities[index]))
        for name, decision in record.decisions.items():
            expected.update(vector(f"{name}.target", decision.target))
            expected.update(vector(f"{name}.error", decision.error))
            expected.update(vector(f"{name}.nominal_velocity", decision.nominal))
            expected.update(vector(f"{name}.command", decision.command))
            expected.update(vector(f"{name}.jacobian", decision.jacobian))
            expected[f"{name}.error_norm"] = np.linalg.norm(decision.error)
            for barrier in ("collision", "overstretch", "proximity"):
                expected[f"{name}.h_{barrier}"] = decision.h[barrier]
                expected[f"{name}.slack_{barrier}"] = decision.slack[barrier]
            for scalar in "exact_jacobian leader_drift status rows solve_time".split():
                expected[f"{name}.{scalar}"] = float(getattr(decision, scalar))
        assert row == pytest.approx(expected, rel=1e-11)


def vector(name, values):
    return {f"{name}_{axis}": value for axis, value in zip("xyz", values)}


def test_the_caller_may_reuse_its_arrays(scenario, tmp_path):
    recorder = RunRecorder(scenario, tmp_path / "run")
    record = make_record(scenario, 0)
    recorder.record(record)
    record.positions[:] = np.nan
    record.points[:] = np.nan
    recorder.finish(1.0, True)
    assert read_table(tmp_path / "run")["leader.position_y"][0] == 1.0
    assert np.isfinite(np.load(tmp_path / "run" / "states.npz")["points"]).all()


def test_runs_longer_than_expected_lose_nothing(scenario, tmp_path, monkeypatch):
    monkeypatch.setattr("deformable_manipulation.recording.timeseries.INITIAL_ROWS", 4)
    summary = record_run(scenario, tmp_path / "run", 150).finish(1.0, True)
    assert summary["cycles"] == 150
    table = read_table(tmp_path / "run")
    np.testing.assert_array_equal(table["cycle"], np.arange(150))
    np.testing.assert_allclose(table["leader.velocity_z"], -2.0 - np.arange(150))
    assert summary["timing"]["simulation"]["median_ms"] == pytest.approx(75.5)


def test_states_hold_frames_at_the_record_rate(scenario, tmp_path):
    record_run(scenario, tmp_path / "run", 101).finish(1.0, True)
    states = np.load(tmp_path / "run" / "states.npz")
    np.testing.assert_allclose(states["times"], np.arange(11) / 10, rtol=1e-6)
    assert states["points"].shape == (11, POINTS, 3)
    assert states["agents"].shape == (11, 2, 3)
    assert states["points"].dtype == states["agents"].dtype == np.float32
    assert list(states["agent_names"]) == ["leader", "assistant_1"]
    np.testing.assert_allclose(states["points"][3], make_record(scenario, 30).points, rtol=1e-6)
    assert "faces" not in states


@pytest.mark.parametrize("record_rate, frames", [(30.0, 30), (33.3, 33), (100.0, 100)])
def test_record_rates_that_do_not_divide_the_rate(tmp_path, record_rate, frames):
    scenario = make_scenario(tmp_path, record_rate=record_rate)
    record_run(scenario, tmp_path / "run", 100).finish(1.0, True)
    assert len(np.load(tmp_path / "run" / "states.npz")["times"]) == frames


def test_faces_of_a_fabric_are_kept(scenario, tmp_path):
    corners = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (1.0, 1.0, 0.0))
    faces = ((0, 1, 2), (1, 3, 2))
    fabric = FabricSpec(corners, faces, 1.0, 0.001, 1e-4, 1.0)
    RunRecorder(dataclasses.replace(scenario, object=fabric), tmp_path / "run").finish(1, True)
    np.testing.assert_array_equal(np.load(tmp_path / "run" / "states.npz")["faces"], faces)


def test_scenario_file_describes_the_same_scenario(scenario, tmp_path):
    RunRecorder(scenario, tmp_path / "run")
    mapping = yaml.safe_load((tmp_path / "run" / "scenario.yaml").read_text())
    assert scenario_from_mapping(mapping, tmp_path) == scenario


def test_summary_numbers(scenario, tmp_path):
    recorder = RunRecorder(scenario, tmp_path / "run", safety=False)
    distances = [0.08, 0.031, 0.07, 0.06]
    statuses = [Status.NOMINAL, Status.RELAXED, Status.RELAXED, Status.FAILED]
    for cycle, (distance, status) in enumerate(zip(distances, statuses)):
        decision = dataclasses.replace(
            make_decision(cycle, status=status),
            error=np.array([0.0, 0.3, 0.4]) * (4 - cycle),
            h={
                "collision": distance - OFFSET,
                "overstretch": 0.01 - 0.001 * cycle,
                "proximity": 0.5,
            },
        )
        recorder.record(
            make_record(
                scenario,
                cycle,
                distance=distance,
                stretch=(0.001, -0.02, 0.01, np.nan)[cycle],
                decisions={"assistant_1": decision},
                timings=CycleTimings(0.001 * (cycle + 1), 0.002, np.nan),
            )
        )
    recorder.finish(12.5, True)
    summary = json.loads((tmp_path / "run" / "summary.json").read_text())
    machine = summary.pop("machine")
    assert machine["cores"] >= 1
    assert machine["processor"] and machine["python"]
    error = summary.pop("tracking_error")
    assert error == {
        "assistant_1": pytest.approx({"rms": 0.5 * np.sqrt(30 / 4), "max": 2.0, "final": 0.5})
    }
    assert summary.pop("timing") == {
        "simulation": pytest.approx({"median_ms": 2.5, "p99_ms": 3.97}),
        "distance": pytest.approx({"median_ms": 2.0, "p99_ms": 2.0}),
        "controller": {"median_ms": None, "p99_ms": None},
        "solver": pytest.approx({"median_ms": 0.025, "p99_ms": 0.0299}),  # of two cycles
    }
    assert summary.pop("version").count(".") == 2
    assert summary.pop("worst_violation") == pytest.approx(0.019)
    assert summary.pop("min_margin") == pytest.approx(
        {"collision": -0.019, "overstretch": 0.007, "proximity": 0.5}
    )
    assert summary == {
        "scenario": "synthetic",
        "completed": True,
        "safety": False,
        "start": "stable",
        "duration": 4 / RATE,
        "cycles": 4,
        "rate": RATE,
        "wall_time": 12.5,
        "min_distance": 0.031,
        "offset": OFFSET,
        "max_stretch": 0.02,
        "valid_stretch": 0.01,
        "shape_valid": False,
        "qp_relaxed": 2,
        "qp_failed": 1,
        "waiting": {"assistant_1": {"time": 0.0, "longest": 0.0, "always": False, "reason": ""}},
    }


def test_no_violation_counts_as_zero(scenario, tmp_path):
    summary = record_run(scenario, tmp_path / "run", 1).finish(1.0, True)
    assert summary["min_distance"] == pytest.approx(0.06)
    assert summary["worst_violation"] == 0.0


def test_the_error_of_a_waiting_cycle_is_left_out(scenario, tmp_path):
    recorder = record_run(scenario, tmp_path / "run", 3)
    unknown = dataclasses.replace(make_decision(3), error=np.full(3, np.nan))
    recorder.record(make_record(scenario, 3, decisions={"assistant_1": unknown}))
    summary = recorder.finish(1.0, True)
    assert summary["tracking_error"]["assistant_1"]["final"] == pytest.approx(
        np.linalg.norm(make_decision(2).error)
    )


def record_waiting(scenario, folder, waiting):
    """Runs of cycles, each with why the assistant waits in them, or an empty text."""
    recorder, cycle = RunRecorder(scenario, folder), 0
    for cycles, reason in waiting:
        for _ in range(cycles):
            status = Status.WAITING if reason else Status.NOMINAL
            decision = dataclasses.replace(make_decision(cycle, status=status), reason=reason)
            recorder.record(make_record(scenario, cycle, decisions={"assistant_1": decision}))
            cycle += 1
    return recorder.finish(1.0, True)


def test_waiting_is_told_with_the_reason_of_its_longest_time(scenario, tmp_path):
    waiting = [(30, "no image"), (20, ""), (50, "no state"), (10, ""), (5, "no leader")]
    summary = record_waiting(scenario, tmp_path / "run", waiting)
    wait = {"time": 0.85, "longest": 0.5, "always": False, "reason": "no state"}
    assert summary["waiting"] == {"assistant_1": wait}
    line = "WARNING: assistant_1 waited for 0.8 s in all, for up to 0.5 s at once: no state"
    assert line in describe(summary).splitlines()


def test_an_assistant_that_never_moved_is_told(scenario, tmp_path):
    text = describe(record_waiting(scenario, tmp_path / "run", [(200, "no image")]))
    line = (
        "WARNING: assistant_1 never followed the leader, it waited for all of the 2.0 s: no image"
    )
    assert line in text.splitlines()
    recorded = describe_recorded(read_run(tmp_path / "run"))
    assert line.replace(": no image", "") in recorded.splitlines()


def test_waiting_for_the_first_state_is_not_worth_a_word(scenario, tmp_path):
    text = describe(record_waiting(scenario, tmp_path / "run", [(2, "no state"), (98, "")]))
    assert "waited" not in text


def test_summary_is_strict_json_without_obstacle_or_with_unknown_numbers(scenario, tmp_path):
    unknown = dataclasses.replace(make_decision(0), error=np.full(3, np.nan), h={})
    recorder = RunRecorder(scenario, tmp_path / "run")
    recorder.record(make_record(scenario, 0, distance=np.inf, decisions={"assistant_1": unknown}))
    recorder.finish(float("nan"), True)
    text = (tmp_path / "run" / "summary.json").read_text()
    summary = json.loads(text, parse_constant=lambda name: pytest.fail(f"{name} in JSON"))
    assert summary["min_distance"] is None
    assert summary["worst_violation"] == 0.0
    assert set(summary["min_margin"].values()) == {None}
    assert summary["tracking_error"]["assistant_1"] == {"rms": None, "max": None, "final": None}
    assert summary["wall_time"] is None


def test_a_run_without_a_cycle_leaves_readable_files(scenario, tmp_path):
    summary = RunRecorder(scenario, tmp_path / "run").finish(0.1, False)
    assert summary["cycles"] == 0
    assert summary["min_distance"] is None
    assert not summary["completed"]
    assert len((tmp_path / "run" / "timeseries.csv").read_text().splitlines()) == 1
    assert np.load(tmp_path / "run" / "states.npz")["agents"].shape == (0, 2, 3)


def test_an_existing_run_is_not_touched(scenario, tmp_path):
    record_run(scenario, tmp_path / "run", 5).finish(1.0, True)
    before = {path.name: path.read_bytes() for path in (tmp_path / "run").iterdir()}
    with pytest.raises(RecordingError, match="already contains a run.*--force"):
        RunRecorder(scenario, tmp_path / "run")
    assert {path.name: path.read_bytes() for path in (tmp_path / "run").iterdir()} == before


def test_overwriting_leaves_nothing_of_the_earlier_run(scenario, tmp_path):
    folder = tmp_path / "run"
    record_run(scenario, folder, 5).finish(1.0, True)
    (folder / "notes.txt").write_text("mine")
    RunRecorder(scenario, folder, overwrite=True)
    assert sorted(path.name for path in folder.iterdir()) == ["notes.txt", "scenario.yaml"]


def test_a_folder_that_cannot_be_made_is_told_at_the_start(scenario, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(RecordingError, match="cannot record into .*file/run.*choose"):
        RunRecorder(scenario, tmp_path / "file" / "run")
    with pytest.raises(RecordingError, match="cannot record into .*name too long; choose"):
        RunRecorder(scenario, tmp_path / ("a" * 300))


def test_a_file_that_cannot_be_written_does_not_cost_the_others(scenario, tmp_path, monkeypatch):
    recorder = record_run(scenario, tmp_path / "run", 5)

    def full_disk(*arguments, **keywords):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(run_recorder_module.np, "savez_compressed", full_disk)
    with pytest.raises(RecordingError, match=r"states\.npz: No space left"):
        recorder.finish(1.0, True)
    names = sorted(os.listdir(tmp_path / "run"))
    assert names == ["scenario.yaml", "summary.json", "timeseries.csv"]


def test_no_half_written_file_after_an_interruption(scenario, tmp_path, monkeypatch):
    recorder = record_run(scenario, tmp_path / "run", 5)

    def interrupted(file, **arrays):
        file.write(b"half")
        raise KeyboardInterrupt

    monkeypatch.setattr(run_recorder_module.np, "savez_compressed", interrupted)
    with pytest.raises(KeyboardInterrupt):
        recorder.finish(1.0, True)
    assert sorted(os.listdir(tmp_path / "run")) == ["scenario.yaml", "timeseries.csv"]


def test_an_interruption_within_a_record_keeps_whole_rows_only(scenario, tmp_path):
    recorder = record_run(scenario, tmp_path / "run", 3)
    with pytest.raises(KeyError):
        recorder.record(make_record(scenario, 3, decisions={}))
    recorder.finish(1.0, False)
    np.testing.assert_array_equal(read_table(tmp_path / "run")["cycle"], [0, 1, 2])
