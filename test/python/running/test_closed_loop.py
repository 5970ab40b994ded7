"""The whole chain in one process, on a short run over real ground."""

import json
from pathlib import Path

import numpy as np
import pytest

from deformable_manipulation.commands import run_scenario
from deformable_manipulation.control.status import Status
from deformable_manipulation.distance.factory import make_minimum_distance
from deformable_manipulation.recording import read_run
from deformable_manipulation.running import closed_loop
from deformable_manipulation.running.closed_loop import ClosedLoop
from deformable_manipulation.scenario import load_scenario

SCENARIOS = Path(__file__).resolve().parents[2] / "rostest"
SHORT_ROPE = SCENARIOS / "short_rope.yaml"
TWO_ASSISTANTS = SCENARIOS / "two_assistants.yaml"
TOLERATED = 0.001  # m short of the offset


class Recorder:
    """Keeps the records of a run."""

    def __init__(self):
        self.records = []

    def record(self, record):
        self.records.append(record)


def run(scenario, safety=True):
    recorder = Recorder()
    ClosedLoop(scenario, safety=safety).run(recorder)
    return recorder.records


@pytest.fixture(scope="module")
def scenario():
    return load_scenario(SHORT_ROPE)


@pytest.fixture(scope="module")
def two_assistants():
    return load_scenario(TWO_ASSISTANTS)


@pytest.fixture(scope="module")
def safe(scenario):
    return run(scenario)


@pytest.fixture(scope="module")
def unsafe(scenario):
    return run(scenario, safety=False)


def lowest_distance(records):
    return min(record.distance for record in records)


def test_the_filter_keeps_the_rope_off_the_ground(scenario, safe):
    offset = scenario.controller.collision.offset
    assert offset - TOLERATED <= lowest_distance(safe) < offset + 0.02


def test_the_rope_would_go_into_the_ground_without_it(unsafe):
    assert unsafe[0].distance > 0.2
    assert lowest_distance(unsafe) < -0.05


def test_exact_gradients_keep_the_rope_off_the_ground():
    records = run(load_scenario(SHORT_ROPE, [("controller.jacobian", "equilibrium")]))
    assert all(record.decisions["assistant_1"].exact_jacobian for record in records)
    offset = load_scenario(SHORT_ROPE).controller.collision.offset
    assert offset - TOLERATED <= lowest_distance(records) < offset + 0.02


@pytest.mark.parametrize("height", [1.06, 0.96])
def test_a_start_within_the_offset_or_in_the_ground_is_mended_at_once(height):
    """The violation falls in every cycle, at the assistant's full speed; then it stays outside."""
    changes = {
        "agents.leader.start": f"[0, 0, {height}]",
        "agents.assistant_1.start": f"[0, 1.5, {height}]",
        "object.pose.position": f"[0, 0, {height}]",
        "simulation.duration": "2.5",
    }
    records = run(load_scenario("rope_one_assistant", list(changes.items())))
    distance = np.array([record.distance for record in records])
    offset = 0.05
    assert distance[0] < (offset - 0.015 if height > 1.0 else -0.06)
    outside = int(np.argmax(distance >= offset))
    assert (np.diff(distance[: outside + 1]) >= -1e-9).all()
    assert (distance[outside:] >= offset).all()
    assert 0 < outside < (60 if height > 1.0 else 130)
    command = records[outside // 2].decisions["assistant_1"].command
    assert command[2] > 0.03 and distance[-1] == pytest.approx(offset + 0.002, abs=1e-3)


def test_the_leader_goes_where_its_path_goes(scenario, safe):
    leader = scenario.leader_index
    travelled = safe[-1].positions[leader] - safe[0].positions[leader]
    np.testing.assert_allclose(travelled, scenario.leader.waypoints[-1].position, atol=1e-9)


def test_the_assistant_follows_while_nothing_is_near(safe):
    decisions = [record.decisions["assistant_1"] for record in safe]
    near = next(k for k, each in enumerate(decisions) if each.status == Status.CONSTRAINED)
    assert near > 100
    assert max(each.error_norm for each in decisions[:near]) < 0.005
    assert {each.status for each in decisions} == {Status.NOMINAL, Status.CONSTRAINED}


def test_status_without_the_filter(unsafe):
    statuses = {record.decisions["assistant_1"].status for record in unsafe}
    assert statuses == {Status.UNSAFE_FILTER_OFF}


def test_two_runs_are_the_same(scenario, safe):
    again = run(scenario)
    assert len(again) == len(safe)
    for one, other in zip(safe, again):
        assert one.distance == other.distance
        np.testing.assert_array_equal(one.positions, other.positions)
        np.testing.assert_array_equal(one.points, other.points)
        for name, decision in one.decisions.items():
            np.testing.assert_array_equal(decision.command, other.decisions[name].command)
            np.testing.assert_array_equal(decision.jacobian, other.decisions[name].jacobian)


def test_every_cycle_is_recorded_with_its_own_arrays(scenario, safe):
    assert [record.cycle for record in safe] == list(range(scenario.cycles))
    np.testing.assert_allclose(
        [record.time for record in safe], np.arange(scenario.cycles) * scenario.cycle_time
    )
    compute = make_minimum_distance(scenario).compute
    for record in safe[::100]:
        minimum = compute(record.points[None]).minimum[0]
        assert minimum == pytest.approx(record.distance, abs=1e-12)


def test_a_command_acts_a_cycle_after_the_state_it_answers(safe):
    for record, after in zip(safe, safe[2:]):
        command = record.decisions["assistant_1"].command
        np.testing.assert_allclose(after.velocities[1], command, atol=1e-12)


def test_positions_follow_from_velocities(scenario, safe):
    positions = np.array([record.positions for record in safe])
    velocities = np.array([record.velocities for record in safe])
    np.testing.assert_allclose(
        np.diff(positions, axis=0), scenario.cycle_time * velocities[1:], atol=1e-12
    )


def test_progress_is_told_up_to_the_end(two_assistants):
    told = []
    ClosedLoop(two_assistants).run(progress=told.append)
    assert told == sorted(told) and told[-1] == 1.0
    assert 90 <= len(told) <= 110


def test_two_assistants_share_the_rope_safely(two_assistants):
    records = run(two_assistants)
    offset = two_assistants.controller.collision.offset
    assert offset - TOLERATED <= lowest_distance(records) < offset + 0.02
    assert lowest_distance(run(two_assistants, safety=False)) < 0.0
    for name in ("middle_assistant", "end_assistant"):
        moved = [record.decisions[name].command.any() for record in records]
        assert sum(moved) > 0.9 * len(records)


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    """A run of the command run_scenario: folder and exit status."""
    folder = tmp_path_factory.mktemp("run") / "short"
    return folder, run_scenario.main([str(SHORT_ROPE), "--output", str(folder)])


def test_the_command_records_what_the_loop_does(recorded, safe):
    folder, status = recorded
    assert status == 0
    summary = json.loads((folder / "summary.json").read_text())
    assert summary["completed"] and summary["safety"]
    assert (summary["scenario"], summary["cycles"]) == ("short_rope", len(safe))
    assert summary["min_distance"] == pytest.approx(lowest_distance(safe), abs=1e-12)
    assert summary["worst_violation"] <= TOLERATED
    assert summary["min_margin"]["overstretch"] > 0.0 and summary["min_margin"]["proximity"] > 0.0
    assert summary["qp_failed"] == summary["qp_relaxed"] == 0
    assert set(summary["tracking_error"]) == {"assistant_1"}
    error = safe[-1].decisions["assistant_1"].error_norm
    assert summary["tracking_error"]["assistant_1"]["final"] == pytest.approx(error, abs=1e-9)
    assert set(summary["timing"]) == {"simulation", "distance", "controller", "solver"}
    assert all(timing["median_ms"] > 0.0 for timing in summary["timing"].values())


def test_frames_give_the_distances_of_the_table(recorded, scenario):
    folder, _ = recorded
    data = read_run(folder)
    with np.load(folder / "states.npz") as states:
        times, points, agents = (states[key] for key in ("times", "points", "agents"))
        assert states["agent_names"].tolist() == ["leader", "assistant_1"]
    step = round(scenario.controller.rate / scenario.simulation.record_rate)
    np.testing.assert_allclose(times, data.time[::step], rtol=1e-6)
    assert points.shape == (len(times), scenario.object.segments + 1, 3)
    compute = make_minimum_distance(scenario).compute
    distances = [compute(frame[None].astype(float)).minimum[0] for frame in points]
    np.testing.assert_allclose(distances, data.distance[::step], atol=1e-6)
    np.testing.assert_allclose(agents[0], [agent.start for agent in scenario.agents], atol=1e-6)


def test_the_command_without_the_filter(tmp_path, capsys):
    options = ["--no-safety", "--set", "simulation.duration=7"]
    assert run_scenario.main([str(SHORT_ROPE), "--output", str(tmp_path), *options]) == 0
    summary = json.loads((tmp_path / "summary.json").read_text())
    assert not summary["safety"]
    assert summary["min_distance"] < 0.0
    assert summary["worst_violation"] == pytest.approx(summary["offset"] - summary["min_distance"])
    assert "lowest distance" in capsys.readouterr().out


def test_the_scenario_written_repeats_the_run(recorded, safe):
    folder, _ = recorded
    again = run(load_scenario(folder / "scenario.yaml"))
    np.testing.assert_array_equal(again[-1].points, safe[-1].points)


def test_a_simulation_that_breaks_down_is_no_success(tmp_path, capsys, monkeypatch):
    """A leader faster than any number can tell."""
    monkeypatch.setattr(
        closed_loop.LeaderController, "update", lambda *arguments: np.full(3, 1e305)
    )
    assert run_scenario.main([str(SHORT_ROPE), "--output", str(tmp_path)]) == 1
    assert "run stopped" in capsys.readouterr().err
    assert not json.loads((tmp_path / "summary.json").read_text())["completed"]
