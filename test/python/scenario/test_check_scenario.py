"""The command check_scenario."""

import pytest
import yaml

from deformable_manipulation.commands.check_scenario import main
from deformable_manipulation.scenario import load_scenario, scenario_from_mapping


@pytest.fixture
def path(mapping, tmp_path):
    path = tmp_path / "small.yaml"
    path.write_text(yaml.safe_dump(mapping, sort_keys=False))
    return path


def test_correct_file(path, capsys):
    assert main([str(path)]) == 0
    output = capsys.readouterr()
    assert output.out.startswith("{}: correct\n".format(path))
    for part in ("rod of 2 m", "helper: assistant, holds particle 9", "0.18 to 1.782 m",
                 "block: polygon of 4 points", "250 cycles at 50 Hz"):
        assert part in output.out
    assert output.err == ""


def test_resolved_is_yaml_alone_and_means_the_same(path, capsys):
    assert main(["--resolved", str(path)]) == 0
    mapping = yaml.safe_load(capsys.readouterr().out)
    assert scenario_from_mapping(mapping, "/nowhere") == load_scenario(path)


def test_set(path, capsys):
    arguments = [str(path), "--resolved", "--set", "controller.gain=2",
                 "--set", "leader.waypoints.1.position=[0, 0, 0.5]"]
    assert main(arguments) == 0
    mapping = yaml.safe_load(capsys.readouterr().out)
    assert mapping["controller"]["gain"] == 2.0
    assert mapping["leader"]["waypoints"][1]["position"] == [0.0, 0.0, 0.5]


@pytest.mark.parametrize("options", [[], ["--resolved"]])
def test_mistakes_go_to_stderr(path, capsys, options):
    arguments = [str(path), "--set", "controller.gain=-1", "--set", "object.length=x"]
    assert main(arguments + options) == 1
    output = capsys.readouterr()
    assert output.out == ""
    assert "2 mistakes" in output.err
    assert "controller.gain: -1 \u2014 must be a number > 0 [1/s]" in output.err


@pytest.mark.parametrize("arguments", [[], ["a", "b"], ["a", "--set", "gain"], ["a", "--wrong"],
                                       ["a", "--set", "=1"]])
def test_wrong_usage(arguments, capsys):
    with pytest.raises(SystemExit) as caught:
        main(arguments)
    assert caught.value.code == 2
    assert "usage: check_scenario" in capsys.readouterr().err


def test_help_shows_examples(capsys):
    with pytest.raises(SystemExit) as caught:
        main(["--help"])
    assert caught.value.code == 0
    assert "--set controller.gain=2" in capsys.readouterr().out
