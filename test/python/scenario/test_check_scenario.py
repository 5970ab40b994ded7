"""The command check_scenario."""

import subprocess
import sys

import pytest
import yaml

from deformable_manipulation.commands.check_scenario import main
from deformable_manipulation.scenario import load_scenario, scenario_from_mapping

CHECK = f"{sys.executable} -m deformable_manipulation.commands check_scenario"


@pytest.fixture
def path(mapping, tmp_path):
    path = tmp_path / "small.yaml"
    path.write_text(yaml.safe_dump(mapping, sort_keys=False))
    return path


def test_correct_file(path, capsys):
    assert main([str(path)]) == 0
    output = capsys.readouterr()
    assert output.out.startswith("{}: correct\n".format(path))
    for part in (
        "rod of 2 m",
        "helper: assistant, holds particle 9",
        "0.18 to 1.782 m",
        "block: polygon of 4 points",
        "250 cycles at 50 Hz",
        "controller: full formulation, looks 3 s ahead",
        "1000 kg/m^3, Young's modulus 1e+07 Pa, torsion modulus 4e+06 Pa; mass "
        "0.6283 kg, bending stiffness 0.07854 N m^2",
    ):
        assert part in output.out
    assert output.err == ""


def test_a_name_that_is_not_the_file_s_is_told(path, capsys):
    assert main([str(path), "--set", "name=copied"]) == 0
    assert "WARNING: name: runs and pictures will be called 'copied'" in capsys.readouterr().err


def test_surfaces_without_an_inside_are_told(path, mapping, capsys):
    (path.parent / "sheet.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    mapping["obstacles"].append({"name": "sheet", "mesh": "sheet.obj"})
    path.write_text(yaml.safe_dump(mapping))
    assert main([str(path)]) == 0
    output = capsys.readouterr()
    assert "WARNING: obstacle 'sheet': " in output.err and "no sign" in output.err


TORN = (
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0.5 0\nv 2 0 0\nv 2 1 0\n"
    "f 1 2 3\nf 1 3 4\nf 2 6 5\nf 5 6 7\nf 5 7 3\n"
)


def test_triangles_that_were_split_are_told(fabric_mapping, tmp_path, capsys):
    (tmp_path / "torn.obj").write_text(TORN)
    path = tmp_path / "small.yaml"
    del fabric_mapping["object"]["size"], fabric_mapping["object"]["resolution"]
    fabric_mapping["object"]["mesh"] = "torn.obj"
    fabric_mapping["agents"]["helper"]["particle"] = 1
    fabric_mapping["obstacles"] = [
        {"name": "sheet", "mesh": "torn.obj", "translation": [0.0, 0.0, -9.0]}
    ]
    path.write_text(yaml.safe_dump(fabric_mapping))
    assert main([str(path)]) == 0
    output = capsys.readouterr()
    told = "1 place where a vertex lies on the edge of a triangle that does not have it"
    assert "WARNING: object.mesh: " + told in output.err
    assert "WARNING: obstacle 'sheet': " + told in output.err
    assert "(1, 0.5, 0)" in output.err and "6 triangles" in output.out


def test_material_of_a_fabric(fabric_mapping, tmp_path, capsys):
    path = tmp_path / "small.yaml"
    path.write_text(yaml.safe_dump(fabric_mapping))
    assert main([str(path), "--set", "object.stretching_compliance=0"]) == 0
    expected = (
        "0.5 kg/m^2, thickness 0.002 m, stretching stiffness rigid, bending stiffness 0.0001 N m"
    )
    assert expected in capsys.readouterr().out


def test_resolved_is_yaml_alone_and_means_the_same(path, capsys):
    assert main(["--resolved", str(path)]) == 0
    mapping = yaml.safe_load(capsys.readouterr().out)
    assert scenario_from_mapping(mapping, "/nowhere") == load_scenario(path)


def test_set(path, capsys):
    arguments = [
        str(path),
        "--resolved",
        "--set",
        "controller.gain=2",
        "--set",
        "leader.waypoints.1.position=[0, 0, 0.5]",
    ]
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


@pytest.mark.parametrize(
    "arguments", [[], ["a", "b"], ["a", "--set", "gain"], ["a", "--wrong"], ["a", "--set", "=1"]]
)
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


def resolved(path, capsys, *options):
    assert main([str(path), "--resolved", *options]) == 0
    return yaml.safe_load(capsys.readouterr().out)


@pytest.mark.parametrize(
    "text, gain, start",
    [
        ("", 1.0, [0.0, 1.5, 1.0]),
        ("controller.gain=2", 2.0, [0.0, 1.5, 1.0]),
        ("  controller.gain=2 agents.helper.start=[0.0, 1.4, 1.0]\n", 2.0, [0.0, 1.4, 1.0]),
        ("agents.helper.start=[0.0, 1.4, 1.0]   controller.gain= 2", 2.0, [0.0, 1.4, 1.0]),
    ],
)
def test_several_values_in_one_text(path, capsys, text, gain, start):
    mapping = resolved(path, capsys, "--sets", text)
    assert mapping["controller"]["gain"] == gain
    assert mapping["agents"]["helper"]["start"] == start


def test_texts_with_blanks_among_several_values(path, capsys):
    mapping = resolved(path, capsys, "--sets", 'name="two words" controller.gain=2')
    assert (mapping["name"], mapping["controller"]["gain"]) == ("two words", 2.0)


def test_several_values_that_have_no_key_are_wrong_usage(path, capsys):
    with pytest.raises(SystemExit) as caught:
        main([str(path), "--sets", "gain 2"])
    assert caught.value.code == 2
    assert "does not have the form key.path=value" in capsys.readouterr().err


def test_a_launch_s_own_arguments(path, capsys, tmp_path):
    options = ["--assistants", "helper", "--all-assistants", "--leader", "hand"]
    assert main([str(path), *options, "--output", str(tmp_path)]) == 0
    assert main([str(path), "--assistants", ""]) == 0  # all run elsewhere
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize(
    "options, expected",
    [
        (
            ["--assistants", "helpr"],
            "'helpr' \u2014 is not an assistant of the scenario; did you mean",
        ),
        (["--assistants", "hand"], "assistants: helper"),
        (["--assistants", "helper helper"], "contains a name twice"),
        (["--assistants", "", "--all-assistants"], 'use assistants:="helper"'),
        (["--one-process", "maybe"], "one_process: 'maybe' \u2014 allowed: true or false"),
        (["--leader-input", "mouse"], "allowed: waypoints or hand"),
        (["--drag-obstacles", "true"], "no obstacle has motion.topic"),
        (
            ["--one-process", "false", "--set", "controller.cooperation=centralised"],
            "do not use one_process:=false",
        ),
        (["--leader", "helper"], "leader:=hand"),
        (["--output", "/nowhere"], "'/nowhere' \u2014 does not exist"),
        (["--output", "/dev/null"], "is not a folder"),
        (["--namespace", "left-hand"], "namespace: 'left-hand' \u2014 allowed: names of letters"),
        (["--namespace", "/1/left"], "that start with a letter"),
    ],
)
def test_mistakes_in_a_launch_s_own_arguments(path, capsys, options, expected):
    assert main([str(path), "--resolved", *options]) == 1
    output = capsys.readouterr()
    assert output.out == ""
    assert expected in output.err


@pytest.mark.parametrize("namespace", ["/", "left", "/left/", "cell_1/left"])
def test_namespaces_of_a_launch(path, namespace):
    assert main([str(path), "--namespace", namespace]) == 0


def test_mistakes_are_the_last_words_after_those_of_the_program_that_checks(tmp_path):
    wrong = tmp_path / "wrong.yaml"
    wrong.write_text("colour: red\n")
    command = f"{CHECK} --last-word --resolved {wrong} || echo 'it failed' >&2; exit 1"
    done = subprocess.run(
        ["bash", "-c", command],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        universal_newlines=True,
        timeout=60,
    )
    assert (done.returncode, done.stdout) == (1, "")
    lines = done.stderr.splitlines()
    assert lines[0] == "it failed"
    assert lines[1].startswith(str(wrong)) and "colour" in done.stderr


def test_the_name_of_a_copy_is_told_for_launches_too(path, capsys):
    assert main(["--resolved", str(path), "--set", "name=copied"]) == 0
    assert "will be called 'copied'" in capsys.readouterr().err


def test_mistakes_of_set_say_so(path, capsys):
    assert main([str(path), "--set", "controller.gain=abc", "--set", "object.colour=red"]) == 1
    mistakes = capsys.readouterr().err.splitlines()[1:]
    assert len(mistakes) == 2
    assert all(line.endswith("(given by --set)") for line in mistakes)


def test_imperfect_knowledge_is_not_for_launches(path, capsys):
    imperfect = [str(path), "--set", "knowledge.pose_noise=0.001"]
    assert main(imperfect) == 0
    assert main([*imperfect, "--assistants", "helper"]) == 1
    assert "runs without ROS" in capsys.readouterr().err


def test_all_mistakes_in_a_launch_s_arguments_at_once(path, capsys):
    assert main([str(path), "--assistants", "a b", "--leader", "c", "--output", "/d"]) == 1
    assert "launch arguments: 4 mistakes" in capsys.readouterr().err
