"""The command new_scenario."""

import dataclasses
import os
import subprocess
import xml.etree.ElementTree as ElementTree

import pytest
import yaml

from deformable_manipulation.authoring.launch_file import NOT_PASSED_ON
from deformable_manipulation.authoring.places import rviz_file_of
from deformable_manipulation.authoring.rviz_choice import rviz_configuration
from deformable_manipulation.commands.new_scenario import main
from deformable_manipulation.scenario import load_scenario, package_share_directory

SHARE = package_share_directory()
ENDINGS = (".yaml", ".launch", ".rviz")


def files_of(folder, name):
    return [folder / (name + ending) for ending in ENDINGS]


def settings_of(launch):
    (include,) = ElementTree.parse(str(launch)).getroot().findall("include")
    return {each.get("name"): each.get("value") for each in include.findall("arg")}


@pytest.mark.parametrize("kind", ["rod", "fabric"])
def test_a_scenario_from_a_template(tmp_path, capsys, kind):
    assert main(["my_own", "--object", kind, "--output", str(tmp_path / "new")]) == 0
    files = files_of(tmp_path / "new", "my_own")
    assert capsys.readouterr().out.split("next:")[0].split() == [
        os.path.relpath(str(file)) for file in files
    ]
    scenario = load_scenario(files[0])
    assert (scenario.name, scenario.object.type) == ("my_own", kind)
    assert "# What is carried." in files[0].read_text()
    assert rviz_configuration(files[0], scenario) == files[2]


@pytest.mark.parametrize("sourced", [True, False])
def test_the_printed_commands_run_as_they_are_printed(tmp_path, capsys, monkeypatch, sourced):
    monkeypatch.chdir(tmp_path)
    setup = os.environ.get("DEFORMABLE_MANIPULATION_SETUP")
    if sourced:
        monkeypatch.delenv("DEFORMABLE_MANIPULATION_SETUP", raising=False)
    elif setup is None:
        pytest.skip("needs a run by scripts/with_environment, which knows what to source")
    assert main(["my_own", "--output", "a folder"]) == 0
    lines = capsys.readouterr().out.split("next:\n")[1].splitlines()
    source = [line for line in lines if line.strip().startswith("source ")]
    assert bool(source) != sourced
    check, run, plot, snapshot, launch = lines[len(source) :]
    run += " --set simulation.duration=0.1"
    outputs = [
        subprocess.run(
            ["bash", "-e", "-c", "\n".join([*source, line])],
            check=True,
            stdout=subprocess.PIPE,
            universal_newlines=True,
        ).stdout
        for line in (check, run, plot, snapshot + " --help", launch + " --nodes")
    ]
    assert "my_own.yaml: correct" in outputs[0]
    assert (tmp_path / "my_own_run" / "overview.png").is_file()
    assert "/simulator" in outputs[-1].split()


def test_a_package_that_ros_does_not_know_yet_is_named(tmp_path, capsys):
    (tmp_path / "package.xml").write_text("<package><name>unbuilt_package</name></package>")
    assert main(["my_own", "--output", str(tmp_path)]) == 0
    assert "# build and source the workspace of the package unbuilt_package" in (
        capsys.readouterr().out
    )


@pytest.mark.parametrize("name", ["rope_two_assistants", "fabric_three_assistants"])
def test_a_copy_of_a_scenario_is_the_same_but_for_its_name(tmp_path, name):
    assert main(["other", "--from", name, "--output", str(tmp_path)]) == 0
    scenario, _, rviz = files_of(tmp_path, "other")
    assert load_scenario(scenario) == dataclasses.replace(load_scenario(name), name="other")
    assert rviz.read_text() == (SHARE / "rviz" / f"{name}.rviz").read_text()
    comments = [line for line in scenario.read_text().splitlines() if line.startswith("#")]
    assert comments and comments[0] in (SHARE / "config" / "scenarios" / f"{name}.yaml").read_text()


def test_a_copy_of_one_s_own_scenario_finds_its_files(tmp_path):
    (tmp_path / "old").mkdir()
    (tmp_path / "old" / "hill.csv").write_text("0,0\n1,0\n1,1\n")
    text = (SHARE / "test" / "rostest" / "short_rope.yaml").read_text()
    text = text.replace("package://deformable_manipulation/config/obstacles/ground.csv", "hill.csv")
    old = tmp_path / "old" / "old.yaml"
    old.write_text(text + "frame: world\n")
    assert main(["new", "--from", str(old), "--output", str(tmp_path / "there")]) == 0
    scenario, launch, rviz = files_of(tmp_path / "there", "new")
    assert load_scenario(scenario) == dataclasses.replace(load_scenario(old), name="new")
    assert "polygon: ../old/hill.csv" in scenario.read_text()
    manager = yaml.safe_load(rviz.read_text())["Visualization Manager"]
    assert manager["Global Options"]["Fixed Frame"] == "world"


def test_launch_files_side_by_side_find_their_scenario_wherever_they_are(tmp_path):
    main(["my_own", "--output", str(tmp_path)])
    assert settings_of(tmp_path / "my_own.launch") == {
        "scenario": "$(dirname)/my_own.yaml",
        "rviz_config": "$(dirname)/my_own.rviz",
    }


def test_launch_files_have_the_arguments_of_the_shipped_ones(tmp_path):
    main(["my_own", "--from", "rope_two_assistants", "--output", str(tmp_path)])

    def arguments(path):
        return [each.attrib for each in ElementTree.parse(str(path)).getroot().findall("arg")]

    own = arguments(tmp_path / "my_own.launch")
    assert own == arguments(SHARE / "launch" / "rope_two_assistants.launch")
    assert not {each["name"] for each in own} & (set(NOT_PASSED_ON) - {"assistants"})


def test_a_leader_of_another_name_is_passed_on(tmp_path):
    source = tmp_path / "led.yaml"
    text = (SHARE / "config" / "templates" / "rod.yaml").read_text()
    source.write_text(text.replace("  leader:\n    particle", "  hand:\n    particle"))
    assert main(["my_own", "--from", str(source), "--output", str(tmp_path)]) == 0
    assert settings_of(tmp_path / "my_own.launch")["leader"] == "hand"


def test_in_a_package_files_go_where_those_of_this_one_are(tmp_path):
    (tmp_path / "package.xml").write_text("<package><name>my_package</name></package>")
    assert main(["my_own", "--output", str(tmp_path)]) == 0
    scenario = tmp_path / "config" / "scenarios" / "my_own.yaml"
    assert load_scenario(scenario).name == "my_own"
    assert settings_of(tmp_path / "launch" / "my_own.launch") == {
        "scenario": "$(find my_package)/config/scenarios/my_own.yaml",
        "rviz_config": "$(find my_package)/rviz/my_own.rviz",
    }
    assert rviz_file_of(scenario) == tmp_path / "rviz" / "my_own.rviz"
    assert rviz_file_of(scenario).is_file()


def test_a_material(tmp_path, capsys):
    assert main(["my_own", "--material", "nylon_rope", "--output", str(tmp_path)]) == 0
    assert load_scenario(tmp_path / "my_own.yaml").object.density == 716.0
    assert main(["other", "--material", "nylon", "--output", str(tmp_path)]) == 1
    assert "did you mean 'nylon_rope'?" in capsys.readouterr().err
    arguments = ["--from", "rope_one_assistant", "--material", "nylon_rope"]
    assert main(["other", *arguments, "--output", str(tmp_path)]) == 1
    assert "the object of rope_one_assistant has no key material" in capsys.readouterr().err
    assert not [file for file in files_of(tmp_path, "other") if file.exists()]


@pytest.mark.parametrize("ending", ENDINGS)
def test_nothing_is_overwritten_and_nothing_half_made(tmp_path, capsys, ending):
    there = tmp_path / ("my_own" + ending)
    there.write_text("mine")
    assert main(["my_own", "--output", str(tmp_path)]) == 1
    assert f"{there} already exists" in capsys.readouterr().err
    assert there.read_text() == "mine"
    assert list(tmp_path.iterdir()) == [there]


@pytest.mark.parametrize(
    "name, hint",
    [
        ("My Rope", "my_rope"),
        ("2ropes", "ropes"),
        ("a", None),
        ("", None),
        ("../my_rope", "my_rope"),
        ("my__rope", "my_rope"),
        ("rope_", "rope"),
        ("seil\u00e4", "seil"),
        ("a" * 101, "a" * 100),
    ],
)
def test_names_that_are_none(tmp_path, capsys, name, hint):
    with pytest.raises(SystemExit) as caught:
        main([name, "--output", str(tmp_path)])
    assert caught.value.code == 2
    error = capsys.readouterr().err
    assert "is not a valid scenario name: use lower-case letters" in error
    assert (f"; try '{hint}'" in error) if hint else ("try" not in error)


@pytest.mark.parametrize(
    "arguments, expected",
    [
        (["--output", ""], "is empty; name a folder"),
        (["--object", "cloth"], "invalid choice"),
        (["--object", "rod", "--from", "rope_one_assistant"], "not allowed with"),
    ],
)
def test_wrong_usage(tmp_path, capsys, arguments, expected):
    with pytest.raises(SystemExit) as caught:
        main(["my_own", *arguments])
    assert caught.value.code == 2
    assert expected in capsys.readouterr().err


def test_reasons_why_there_are_no_files(tmp_path, capsys):
    (tmp_path / "file").write_text("")
    assert main(["my_own", "--output", str(tmp_path / "file")]) == 1
    assert "is not a folder" in capsys.readouterr().err
    assert main(["my_own", "--output", str(tmp_path / "file" / "below")]) == 1
    assert "Not a directory" in capsys.readouterr().err
    assert main(["my_own", "--from", "absent", "--output", str(tmp_path)]) == 1
    assert "no scenario with this name" in capsys.readouterr().err
    (tmp_path / "package.xml").write_text("<package/>")
    assert main(["my_own", "--output", str(tmp_path)]) == 1
    assert "does not contain the name of the package" in capsys.readouterr().err
    assert sorted(path.name for path in tmp_path.iterdir()) == ["file", "package.xml"]
