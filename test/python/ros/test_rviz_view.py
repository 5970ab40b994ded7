import copy

import pytest
import yaml

from deformable_manipulation.ros.rviz_view import bare_view, read_configuration
from deformable_manipulation.scenario import package_share_directory
from deformable_manipulation.system.program import ProgramError

FOLDER = package_share_directory() / "rviz"


@pytest.fixture(params=sorted(FOLDER.glob("*.rviz")), ids=lambda path: path.stem)
def path(request):
    return request.param


def test_every_configuration_has_the_views_of_the_paper(path):
    manager = yaml.safe_load(path.read_text())["Visualization Manager"]
    names = {view["Name"] for view in manager["Views"]["Saved"]}
    assert {"Perspective", "YZ", "XY"} <= names


@pytest.mark.parametrize("name", [None, "YZ", "XY"])
def test_the_view_fills_the_window(path, name):
    original = yaml.safe_load(path.read_text())
    before = copy.deepcopy(original)
    result = bare_view(original, name, (640, 400))
    assert original == before
    window = result["Window Geometry"]
    assert (window["Width"], window["Height"]) == (640, 400)
    assert result["Panels"] == []
    current = result["Visualization Manager"]["Views"]["Current"]
    expected = "Perspective" if name is None else name
    assert current["Name"] == expected
    displays = before["Visualization Manager"]["Displays"]
    shown = result["Visualization Manager"]["Displays"]
    left_out = [display["Class"] for display in displays if display not in shown]
    assert left_out == ["rviz/InteractiveMarkers"]


def test_an_unknown_view_is_told_with_those_there_are(path):
    with pytest.raises(ProgramError, match="'side'.*saved: 'Perspective', 'YZ', 'XY'"):
        read_configuration(path, "side", (640, 400))


@pytest.mark.parametrize("text", ["", "a: [", "Panels: []", "Visualization Manager: 3"])
def test_a_file_that_is_no_configuration(tmp_path, text):
    path = tmp_path / "x.rviz"
    path.write_text(text)
    with pytest.raises(ProgramError, match="x.rviz is not an RViz configuration"):
        read_configuration(path, None, (640, 400))


@pytest.mark.parametrize(
    "path, reason", [("absent.rviz", "No such file"), ("/dev/zero", "not a regular file")]
)
def test_a_file_that_cannot_be_read(tmp_path, path, reason):
    with pytest.raises(ProgramError, match=reason):
        read_configuration(tmp_path / path, None, (640, 400))
