"""Frames of a run folder and of a bag."""

import dataclasses

import numpy as np
import pytest
from bag_writing import BagWriter
from synthetic_run import RATE, make_record, make_scenario

from deformable_manipulation.recording import RunDataError, RunRecorder, read_run
from deformable_manipulation.recording.frame_reader import read_frames
from deformable_manipulation.scenario.spec import PolygonObstacle, TopicMotion

CYCLES = 41  # at 100 Hz; frames at 10 Hz


@pytest.fixture
def scenario(tmp_path):
    return make_scenario(tmp_path, assistants=2)


@pytest.fixture
def run_folder(tmp_path, scenario):
    folder = tmp_path / "trial"
    recorder = RunRecorder(scenario, folder)
    for cycle in range(CYCLES):
        recorder.record(make_record(scenario, cycle))
    recorder.finish(1.0, True)
    return folder


def write_bag(path, scenario, cycles, reset_count=0, info="/run_info"):
    names = [agent.name for agent in scenario.agents]
    with BagWriter(path) as writer:
        if info:
            writer.run_info(scenario, info)
        for run in range(reset_count + 1):
            for cycle in cycles:
                record = make_record(scenario, cycle)
                # In another order than the scenario's.
                agents = dict(reversed(list(zip(names, record.positions + run))))
                writer.object_state(cycle, record.points, agents, reset_count=run)
                writer.distances(cycle, reset_count=run, obstacle_poses=record.obstacles + run)
                writer.controller_state(cycle, reset_count=run)


def test_a_folder_has_the_frames_that_were_recorded(run_folder, scenario):
    frames = read_frames(read_run(run_folder))
    np.testing.assert_allclose(frames.times, [0.0, 0.1, 0.2, 0.3, 0.4], atol=1e-6)
    assert frames.scenario == scenario and frames.faces is None
    for frame in range(5):
        record = make_record(scenario, 10 * frame)
        np.testing.assert_allclose(frames.points[frame], record.points, atol=1e-6)
        np.testing.assert_allclose(frames.agents[frame], record.positions, atol=1e-6)
    assert frames.at(0.27) == 3 and frames.at(99.0) == 4


def test_a_bag_of_the_same_run_has_the_same(run_folder, scenario, tmp_path):
    write_bag(tmp_path / "run.bag", scenario, range(CYCLES))
    folder = read_frames(read_run(run_folder))
    bag = read_frames(read_run(tmp_path / "run.bag"))
    assert bag.scenario == folder.scenario
    for name in ("times", "points", "agents"):
        np.testing.assert_allclose(getattr(bag, name), getattr(folder, name), atol=1e-6)


def test_folder_and_bag_have_the_poses_of_moving_obstacles(scenario, tmp_path):
    corners = ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0))
    standing = PolygonObstacle("standing", corners)
    moving = dataclasses.replace(standing, name="moving", motion=TopicMotion("pose"))
    scenario = dataclasses.replace(scenario, obstacles=(standing, moving))
    recorder = RunRecorder(scenario, tmp_path / "folder")
    for cycle in range(CYCLES):
        recorder.record(make_record(scenario, cycle))
    recorder.finish(1.0, True)
    write_bag(tmp_path / "run.bag", scenario, range(CYCLES), reset_count=1)
    for name, shift in (("folder", 0.0), ("run.bag", 1.0)):
        frames = read_frames(read_run(tmp_path / name))
        expected = [np.full((1, 7), 10.0 * frame + shift) for frame in range(5)]
        np.testing.assert_allclose(frames.obstacles, expected)
        assert frames.obstacles_at(2)[0] == standing
        assert frames.obstacles_at(2)[1].translation == (20.0 + shift,) * 3


@pytest.mark.parametrize("topic", ["run_info", "/left/run_info"])
def test_the_scenario_is_found_whatever_the_namespace(scenario, tmp_path, topic):
    write_bag(tmp_path / "run.bag", scenario, range(3), info=topic)
    assert read_frames(read_run(tmp_path / "run.bag")).scenario == scenario


def test_the_run_of_the_chosen_namespace_is_read(scenario, tmp_path):
    with BagWriter(tmp_path / "run.bag") as writer:
        for cycle in range(3):
            for sign, namespace in ((1.0, "/left"), (-1.0, "/right")):
                record = make_record(scenario, cycle)
                writer.controller_state(cycle, namespace=namespace)
                names = [agent.name for agent in scenario.agents]
                agents = dict(zip(names, sign * record.positions))
                writer.object_state(cycle, sign * record.points, agents, namespace=namespace)
        writer.run_info(scenario, "/right/run_info")
    frames = read_frames(read_run(tmp_path / "run.bag", "right"))
    np.testing.assert_allclose(frames.agents[0], -make_record(scenario, 0).positions, atol=1e-6)


def test_only_the_last_run_of_a_bag_counts(scenario, tmp_path):
    write_bag(tmp_path / "run.bag", scenario, range(0, CYCLES, 10), reset_count=1)
    frames = read_frames(read_run(tmp_path / "run.bag"))
    assert len(frames.times) == 5
    np.testing.assert_allclose(frames.agents[2], make_record(scenario, 20).positions + 1, atol=1e-6)


def test_a_bag_without_its_scenario_says_what_to_record(scenario, tmp_path):
    write_bag(tmp_path / "run.bag", scenario, range(3), info=None)
    with pytest.raises(RunDataError, match="record:=true"):
        read_frames(read_run(tmp_path / "run.bag"))


def test_a_bag_without_states_says_so(scenario, tmp_path):
    with BagWriter(tmp_path / "run.bag") as writer:
        writer.run_info(scenario)
        writer.cycle(0)
    with pytest.raises(RunDataError, match="the topic state"):
        read_frames(read_run(tmp_path / "run.bag"))


def test_a_folder_without_frames_says_so(run_folder):
    run = read_run(run_folder)
    (run_folder / "states.npz").unlink()
    with pytest.raises(RunDataError, match=r"no states\.npz"):
        read_frames(run)
    (run_folder / "states.npz").write_bytes(b"nonsense")
    with pytest.raises(RunDataError, match="cannot be read"):
        read_frames(run)


def test_frames_are_at_the_scenario_s_record_rate(scenario, tmp_path):
    write_bag(tmp_path / "run.bag", scenario, range(CYCLES))
    frames = read_frames(read_run(tmp_path / "run.bag"))
    assert np.allclose(np.diff(frames.times), 10.0 / RATE)


def test_frames_that_are_cut_off_are_told(run_folder):
    run = read_run(run_folder)
    path = run_folder / "states.npz"
    path.write_bytes(path.read_bytes()[:-50])
    with pytest.raises(RunDataError, match="cannot be read"):
        read_frames(run)
