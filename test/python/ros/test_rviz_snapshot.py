import pytest
from synthetic_run import make_record, make_scenario

from deformable_manipulation.commands.arguments import times_of
from deformable_manipulation.commands.rviz_snapshot import main
from deformable_manipulation.commands.snapshot_arguments import size_of
from deformable_manipulation.commands.snapshot_pictures import film_times, picture_name
from deformable_manipulation.commands.snapshot_source import read_source
from deformable_manipulation.recording import RunRecorder


def test_sizes_and_times_are_read():
    assert size_of("1280x800") == (1280, 800)
    assert size_of("640X400") == (640, 400)
    assert times_of("30,60,130") == [30.0, 60.0, 130.0]
    assert times_of("0.25") == [0.25]


@pytest.mark.parametrize("text", ["1280", "1280x", "x", "1x1", "99999x800", "-5x800", "1x2x3"])
def test_wrong_sizes_are_refused(text, capsys):
    with pytest.raises(SystemExit) as stop:
        main(["rope_one_assistant", f"--size={text}"])
    assert stop.value.code == 2
    assert f"'{text}' is not a size: use two numbers from 64 to 8192" in capsys.readouterr().err


@pytest.mark.parametrize("text", ["", "30;60", "-1", "nan", "inf", "10,soon", "10,"])
def test_wrong_times_are_refused(text, capsys):
    with pytest.raises(SystemExit) as stop:
        main(["rope_one_assistant", f"--times={text}"])
    assert stop.value.code == 2
    assert f"'{text}' is not a list of times" in capsys.readouterr().err


def test_a_time_after_the_end_is_refused(capsys):
    assert main(["rope_one_assistant", "--times", "10,161"]) == 1
    assert "161 s is after the end of the scenario; allowed: 0 to 160 s" in capsys.readouterr().err


def test_mistakes_of_the_scenario_are_told(capsys):
    assert main(["rope_one_assistant", "--set", "controller.gain=-1"]) == 1
    assert "controller.gain" in capsys.readouterr().err
    assert main(["rope_one_asistant"]) == 1
    assert "rope_one_assistant" in capsys.readouterr().err


@pytest.mark.parametrize(
    "time, name",
    [(0, "a_t000.png"), (60, "a_t060.png"), (130.0, "a_t130.png"), (7.25, "a_t007.25.png")],
)
def test_pictures_are_named_by_scenario_and_time(time, name):
    assert picture_name("a", [time]) == name


def test_a_picture_of_several_times_is_named_by_all_of_them():
    assert picture_name("a", [7.25, 60], "overlaid") == "a_t007.25_t060_overlaid.png"


@pytest.fixture
def run_folder(tmp_path):
    folder = tmp_path / "trial"
    scenario = make_scenario(tmp_path)
    recorder = RunRecorder(scenario, folder)
    for cycle in range(20):
        recorder.record(make_record(scenario, cycle))
    recorder.finish(1.0, True)
    return folder


def test_a_run_folder_is_shown_as_recorded_and_a_scenario_is_run(run_folder, tmp_path, monkeypatch):
    source = read_source(str(run_folder), [], None)
    assert source.time_range == pytest.approx((0.0, 0.2))
    assert source.scenario.name == "synthetic" and source.frames is not None
    monkeypatch.chdir(tmp_path)
    (tmp_path / "rope_one_assistant").mkdir()  # a folder of pictures
    assert read_source("rope_one_assistant", [], None).time_range == (0.0, 160.0)
    run_folder.rename(tmp_path / "rope_two_assistants")
    assert read_source("rope_two_assistants", [], None).scenario.name == "synthetic"


@pytest.mark.parametrize(
    "options, reason",
    [
        (["--times", "0.1,1"], "--times: 1 s is after the end of the run; allowed: 0 to 0.2 s"),
        (["--set", "controller.gain=2"], "--set cannot change"),
        (["--speed", "2"], "--speed: needs --video"),
        (["--output", "/dev/null/figures"], "cannot write the pictures"),
        (["--video", "/dev/null/a.mp4"], "cannot write the pictures"),
    ],
)
def test_what_cannot_be_made_is_told_at_once(run_folder, options, reason, capsys):
    assert main([str(run_folder), *options]) == 1
    assert reason in capsys.readouterr().err


def test_a_scenario_that_has_not_been_run_cannot_be_filmed(capsys):
    assert main(["rope_one_assistant", "--video", "a.mp4"]) == 1
    assert "run_scenario rope_one_assistant --output DIR" in capsys.readouterr().err
    assert main(["rope_one_assistant", "--namespace", "left"]) == 1
    assert "--namespace is only for bags" in capsys.readouterr().err


@pytest.mark.parametrize("option", ["--speed=0", "--speed=fast", "--video=a.avi", "--layout=heap"])
def test_wrong_options_are_refused(option):
    with pytest.raises(SystemExit) as stop:
        main(["rope_one_assistant", option])
    assert stop.value.code == 2


def test_a_video_lasts_twenty_seconds_unless_told_otherwise():
    times, speed = film_times(0.0, 160.0, None)
    assert speed == 8.0 and len(times) == 20 * 25 + 1
    assert (times[0], times[-1]) == (0.0, pytest.approx(160.0))
    times, speed = film_times(2.0, 8.0, None)
    assert speed == 1.0 and len(times) == 6 * 25 + 1 and times[0] == 2.0
    times, _ = film_times(0.0, 160.0, 32.0)
    assert len(times) == 5 * 25 + 1


def test_what_is_left_to_the_command(run_folder):
    source = read_source(str(run_folder), [], None)
    assert source.middle == [pytest.approx(0.1)]
    times = source.telling_times()
    assert len(times) > 1 and 0.0 <= times[0] < times[-1] <= source.time_range[1]
    assert not source.hides_itself
    fabric = read_source("fabric_three_assistants", [], None)
    assert fabric.hides_itself and fabric.telling_times() == [0.0, 225.0, 450.0, 675.0]
    assert read_source("rope_moving_obstacle", [], None).hides_itself
