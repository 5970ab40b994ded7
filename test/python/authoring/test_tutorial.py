"""docs/tutorial.md: what needs no ROS is done; the rest is done by test_tutorial.py of rostest."""

import importlib
import xml.etree.ElementTree as ElementTree

import pytest
from tutorial import follow

from deformable_manipulation.scenario import package_share_directory

PAGE = package_share_directory() / "docs" / "tutorial.md"
WITH_ROS = ("rviz_snapshot",)
SHORTER = {"run_scenario": ["--set", "simulation.duration=2"]}


def test_every_command_succeeds(tmp_path, monkeypatch, capsys):
    done = []

    def run(command, arguments, folder):
        monkeypatch.chdir(folder)
        module = importlib.import_module("deformable_manipulation.commands." + command)
        done.append(command)
        if command not in WITH_ROS:
            status = module.main(arguments + SHORTER.get(command, []))
            output = capsys.readouterr()
            assert status == 0, (command, arguments, output.err)
            assert "WARNING" not in output.err

    def launch(arguments, folder):
        known = ElementTree.parse(str(folder / arguments[0])).getroot().findall("arg")
        names = {each.get("name") for each in known}
        assert {argument.partition(":=")[0] for argument in arguments[1:]} <= names
        done.append("roslaunch")

    follow(PAGE, tmp_path, run, launch)
    assert {"new_scenario", "check_scenario", "run_scenario", "plot_run", "roslaunch"} < set(done)
    assert (tmp_path / "my_work" / "rope_run" / "overview.png").is_file()


@pytest.mark.parametrize("options, lowest", [([], "55.1 mm"), (["--no-safety"], "-143.7 mm")])
def test_the_rope_is_carried_as_the_page_says(tmp_path, capsys, options, lowest):
    from deformable_manipulation.commands import new_scenario, run_scenario

    assert new_scenario.main(["my_rope", "--output", str(tmp_path)]) == 0
    scenario, run = str(tmp_path / "my_rope.yaml"), str(tmp_path / "run")
    assert run_scenario.main([scenario, "--output", run, *options]) == 0
    output = capsys.readouterr()
    assert lowest in output.out + output.err
    assert lowest in PAGE.read_text(encoding="utf-8")
