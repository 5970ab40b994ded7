import pytest

from deformable_manipulation.commands.rviz_snapshot import (
    main,
    picture_name,
    size_of,
    times_of,
)


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
    assert f"'{text}' is no size: two numbers of 64 to 8192" in capsys.readouterr().err


@pytest.mark.parametrize("text", ["", "30;60", "-1", "nan", "inf", "10,soon", "10,"])
def test_wrong_times_are_refused(text, capsys):
    with pytest.raises(SystemExit) as stop:
        main(["rope_one_assistant", f"--times={text}"])
    assert stop.value.code == 2
    assert f"'{text}' are no times" in capsys.readouterr().err


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
    assert picture_name("a", time) == name


