import shutil

import numpy as np
import pytest
from bag_writing import MESSAGES, BagWriter, make_typestore
from synthetic_run import OFFSET, RATE, make_decision

from deformable_manipulation.recording import RunDataError, read_run

needs_rosbag = pytest.mark.skipif(shutil.which("rosbag") is None, reason="rosbag not on PATH")


@pytest.fixture
def bag(tmp_path):
    return tmp_path / "run.bag"


def write_run(path, cycles=range(20), **keywords):
    with BagWriter(path, **keywords) as writer:
        for cycle in cycles:
            writer.cycle(cycle)


def remove_index(path, target):
    """Make of a bag what a killed recorder leaves: no index, and a header that knows of none.

    The recorder pads the header's record to a length that the reindexing relies on.
    """
    data = path.read_bytes()
    counters = {b"index_pos=": 8, b"conn_count=": 4, b"chunk_count=": 4}
    first_chunk = len(b"#ROSBAG V2.0\n") + 4096
    header = bytearray(data[:first_chunk])
    for name, size in counters.items():
        position = header.index(name) + len(name)
        if name == b"index_pos=":
            index = int.from_bytes(header[position : position + size], "little")
        header[position : position + size] = bytes(size)
    padding = header.index(b" " * 100) - 4
    length = int.from_bytes(header[padding : padding + 4], "little")
    header[padding : padding + 4] = (length + 8).to_bytes(4, "little")
    target.write_bytes(bytes(header) + b" " * 8 + data[first_chunk:index])


@pytest.mark.parametrize("compression", [None, "bz2", "lz4"])
def test_every_series_comes_from_the_messages(bag, compression):
    formats = BagWriter(bag)._writer.CompressionFormat
    write_run(bag, compression=compression and formats[compression.upper()])
    run = read_run(bag)
    assert run.name == "run"
    assert run.notes == ()
    assert run.offset == pytest.approx(OFFSET)
    (series,) = run.assistants
    assert series.agent == "assistant_1"
    decisions = [make_decision(cycle) for cycle in range(20)]
    np.testing.assert_allclose(run.time, np.arange(20) / RATE, atol=1e-6)
    np.testing.assert_allclose(series.time, np.arange(20) / RATE, atol=1e-6)
    np.testing.assert_array_equal(run.distance, [decision.distance for decision in decisions])
    for name in ("collision", "overstretch", "proximity"):
        expected = [decision.h[name] for decision in decisions]
        np.testing.assert_array_equal(series.h[name], expected)
    for name in "distance error_norm command status".split():
        expected = [getattr(decision, name) for decision in decisions]
        np.testing.assert_array_equal(getattr(series, name), expected)
    expected = [decision.nominal for decision in decisions]
    np.testing.assert_array_equal(series.nominal_velocity, expected)


def test_several_assistants_in_a_namespace(bag):
    with BagWriter(bag) as writer:
        for cycle in range(5):
            writer.distances(cycle, namespace="/lab/left")
            for agent in ("assistant_2", "assistant_1"):
                writer.controller_state(cycle, agent, namespace="/lab/left")
    run = read_run(bag)
    assert [series.agent for series in run.assistants] == ["assistant_1", "assistant_2"]
    assert len(run.distance) == 5


def test_runs_side_by_side_need_a_choice(bag):
    with BagWriter(bag) as writer:
        for cycle in range(5):
            writer.cycle(cycle, namespace="/left")
            writer.controller_state(cycle, namespace="/right")
            writer.distances(cycle, namespace="/right", minimum=0.5)
    with pytest.raises(RunDataError, match="several runs.*--namespace: /left, /right"):
        read_run(bag)
    assert read_run(bag, "left").distance[0] == pytest.approx(0.06)
    assert read_run(bag, "/right/").distance[0] == 0.5
    with pytest.raises(RunDataError, match="no namespace middle; it contains: /left, /right"):
        read_run(bag, "middle")


def test_without_distances_the_controller_knows_them(bag):
    with BagWriter(bag) as writer:
        for cycle in range(5):
            writer.controller_state(cycle)
    run = read_run(bag)
    np.testing.assert_array_equal(run.distance, run.assistants[0].distance)


def test_a_recorder_that_started_late_does_not_shift_time(bag):
    write_run(bag, cycles=range(300, 310))
    run = read_run(bag)
    np.testing.assert_allclose(run.time, np.arange(300, 310) / RATE, atol=1e-6)


def test_missing_and_repeated_messages(bag):
    write_run(bag, cycles=[0, 1, 1, 2, 5, 6])
    run = read_run(bag)
    np.testing.assert_allclose(run.time, np.array([0, 1, 2, 5, 6]) / RATE, atol=1e-6)
    assert run.notes == ()


def test_the_last_run_is_read_after_resets(bag):
    with BagWriter(bag) as writer:
        for reset_count, cycles in enumerate((50, 30, 7)):
            for cycle in range(cycles):
                writer.cycle(cycle, reset_count=reset_count)
    run = read_run(bag)
    assert len(run.time) == len(run.assistants[0].time) == 7
    assert "3 runs" in run.notes[0]


def test_the_last_run_is_read_after_a_restart(bag):
    with BagWriter(bag) as writer:
        for cycle in (*range(50), *range(9)):
            writer.cycle(cycle)
    run = read_run(bag)
    assert len(run.time) == 9
    assert "2 runs" in run.notes[0]


@pytest.mark.parametrize("resets", [(0, 1), (0, 0)])
def test_a_controller_that_is_silent_in_the_last_run_is_left_out(bag, resets):
    with BagWriter(bag) as writer:
        for cycle in range(10):
            writer.cycle(cycle, reset_count=resets[0])
            writer.controller_state(cycle, "assistant_2", reset_count=resets[0])
        for cycle in range(5):
            writer.cycle(cycle, reset_count=resets[1])
    run = read_run(bag)
    assert [series.agent for series in run.assistants] == ["assistant_1"]
    assert any("assistant_2 sent nothing" in note for note in run.notes)


def test_no_controller_in_the_last_run(bag):
    with BagWriter(bag) as writer:
        writer.cycle(0)
        writer.distances(0, reset_count=1)
    with pytest.raises(RunDataError, match="no controller .* in the last run"):
        read_run(bag)


def test_unknown_numbers_stay_unknown(bag):
    with BagWriter(bag) as writer:
        writer.distances(0, minimum=np.inf)
        writer.controller_state(0, h_collision=np.nan, distance=np.nan, error_norm=np.nan)
    run = read_run(bag)
    assert run.offset is None
    assert np.isinf(run.distance[0])
    assert np.isnan(run.assistants[0].error_norm[0])


def test_other_topics_are_passed_over_and_named_when_nothing_fits(bag):
    with BagWriter(bag) as writer:
        text = writer.typestore.types["std_msgs/msg/String"]
        writer.write("/chatter", "std_msgs/msg/String", text("hello"))
    with pytest.raises(RunDataError, match=r"no .*ControllerState.*/chatter \(std_msgs/msg/String"):
        read_run(bag)
    bag.unlink()
    with BagWriter(bag) as writer:
        writer.write("/chatter", "std_msgs/msg/String", text("hello"))
        writer.cycle(0)
    assert len(read_run(bag).time) == 1


def test_a_topic_of_that_name_with_another_type_is_no_controller(bag):
    with BagWriter(bag) as writer:
        text = writer.typestore.types["std_msgs/msg/String"]
        writer.write("/a/controller_state", "std_msgs/msg/String", text("hello"))
    with pytest.raises(RunDataError, match="contains no deformable_manipulation"):
        read_run(bag)


def test_recordings_without_a_list_of_barriers_have_the_plain_scalars(bag):
    definition = (MESSAGES / "ControllerState.msg").read_text()
    lists = ("string[] barriers", "float64[] h", "float64[] slack")
    older = "\n".join(line for line in definition.splitlines() if not line.startswith(lists))
    with BagWriter(bag, typestore=make_typestore(ControllerState=older)) as writer:
        writer.cycle(0)
    (series,) = read_run(bag).assistants
    assert {name: values[0] for name, values in series.h.items()} == make_decision(0).h


def test_an_older_message_definition_names_what_is_missing(bag):
    definition = (MESSAGES / "ControllerState.msg").read_text()
    older = "\n".join(line for line in definition.splitlines() if "error_norm" not in line)
    with BagWriter(bag, typestore=make_typestore(ControllerState=older)) as writer:
        writer.cycle(0)
    with pytest.raises(RunDataError, match="another version of .*ControllerState.*error_norm"):
        read_run(bag)


@pytest.mark.parametrize("content", [b"", b"time,distance\n0,1\n", bytes(100)])
def test_files_that_are_no_bag(bag, content):
    bag.write_bytes(content)
    with pytest.raises(RunDataError, match="is empty|is not a bag"):
        read_run(bag)


@needs_rosbag
def test_a_bag_of_a_killed_recorder_is_read_from_a_copy(bag, tmp_path):
    write_run(bag)
    active = tmp_path / "killed" / "run.bag.active"
    active.parent.mkdir()
    remove_index(bag, active)
    before = active.read_bytes()
    run = read_run(active)
    assert len(run.time) == 20
    assert run.name == "run"
    assert "repaired copy" in run.notes[0]
    assert active.read_bytes() == before
    assert list(active.parent.iterdir()) == [active]


@needs_rosbag
def test_what_a_truncated_bag_still_holds_is_read_or_refused(bag):
    write_run(bag, cycles=range(50))
    whole = bag.read_bytes()
    for fraction in (0.999, 0.9, 0.5, 0.02):
        bag.write_bytes(whole[: int(fraction * len(whole))])
        try:
            run = read_run(bag)
        except RunDataError as error:
            assert "run.bag" in str(error)
        else:
            assert 0 < len(run.time) <= 50
            np.testing.assert_allclose(run.distance[0], make_decision(0).distance)


def test_a_killed_recorder_s_bag_without_rosbag(bag, tmp_path, monkeypatch):
    write_run(bag)
    active = tmp_path / "run.bag.active"
    remove_index(bag, active)
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(RunDataError, match="no readable index.*rosbag reindex"):
        read_run(active)


def test_bytes_changed_within_a_bag_never_pass_as_another_error(bag):
    write_run(bag, cycles=range(3))
    whole = bag.read_bytes()
    start = whole.index(b"cycle")
    generator = np.random.default_rng(1)
    for position in generator.integers(start, len(whole), 12):
        damaged = bytearray(whole)
        damaged[position] ^= 0xFF
        bag.write_bytes(bytes(damaged))
        try:
            read_run(bag)
        except RunDataError as error:
            assert "run.bag" in str(error) or "controller_state" in str(error)
