"""Every scenario of the package has a launch file and an RViz configuration of its own name."""

import xml.etree.ElementTree as ElementTree

import pytest
import yaml

from deformable_manipulation.scenario import load_scenario, package_share_directory

SHARE = package_share_directory()
NAMES = sorted(path.stem for path in (SHARE / "config" / "scenarios").glob("*.yaml"))
FIND = "$(find deformable_manipulation)"


def arguments(element):
    """Attributes of the arguments that can be set, by name."""
    found = {each.get("name"): each.attrib for each in element.findall("arg")}
    return {name: each for name, each in found.items() if "default" in each}


@pytest.fixture(scope="module")
def common():
    return ElementTree.parse(str(SHARE / "launch" / "run.launch")).getroot()


@pytest.fixture(scope="module", params=NAMES)
def name(request):
    return request.param


@pytest.fixture(scope="module")
def launch(name):
    return ElementTree.parse(str(SHARE / "launch" / f"{name}.launch")).getroot()


def test_scenario_has_the_name_of_its_file(name):
    assert load_scenario(name).name == name


def test_launch_file_starts_the_common_one_with_its_scenario(name, launch):
    (include,) = launch.findall("include")
    assert include.get("file") == f"{FIND}/launch/run.launch"
    assert include.get("pass_all_args") == "true"
    assert {each.get("name"): each.get("value") for each in include} == {
        "scenario": f"{FIND}/config/scenarios/{name}.yaml",
        "rviz_config": f"{FIND}/rviz/{name}.rviz",
    }


def test_arguments_are_those_of_the_common_launch_file(name, launch, common):
    own, known = arguments(launch), arguments(common)
    assistants = [load_scenario(name).agents[i].name for i in load_scenario(name).assistants]
    assert own.pop("assistants")["default"] == " ".join(assistants)
    unused = {"camera"}
    if load_scenario(name).camera is not None:
        unused = set()
        assert own["camera"] == {**known["camera"], "default": "true"}
    for argument in set(own) - {"camera"}:
        assert own[argument] == known[argument]
    assert set(known) - set(own) == {
        "assistants",
        "leader",
        "observers",
        "required",
        "rviz_config",
        "scenario",
        *unused,
    }


def test_rviz_shows_the_markers_in_the_scenario_s_frame(name):
    configuration = yaml.safe_load((SHARE / "rviz" / f"{name}.rviz").read_text())
    manager = configuration["Visualization Manager"]
    assert manager["Global Options"]["Fixed Frame"] == load_scenario(name).frame
    assert "markers" in [display.get("Marker Topic") for display in manager["Displays"]]
