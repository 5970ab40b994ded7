"""The RViz configuration of a scenario."""

from deformable_manipulation.authoring.rviz_choice import own_configuration, rviz_configuration
from deformable_manipulation.scenario import load_scenario, package_share_directory
from deformable_manipulation.scenario.files import find_scenario

RVIZ = package_share_directory() / "rviz"


def test_the_scenario_s_own():
    for name in ("rope_two_assistants", "fabric_three_assistants"):
        chosen = rviz_configuration(find_scenario(name), load_scenario(name))
        assert chosen == RVIZ / f"{name}.rviz"


def test_one_beside_the_file_goes_before_one_of_its_name(tmp_path):
    path = tmp_path / "mine.yaml"
    scenario = load_scenario("rope_two_assistants")
    assert rviz_configuration(path, scenario) == RVIZ / "rope_two_assistants.rviz"
    (tmp_path / "mine.rviz").touch()
    assert rviz_configuration(path, scenario) == tmp_path / "mine.rviz"


def test_one_for_objects_of_its_type(tmp_path):
    for name, expected in (
        ("stiff_rod_one_assistant", "rope_one_assistant"),
        ("fabric_three_assistants", "fabric_three_assistants"),
    ):
        scenario = load_scenario(name, [("name", "nameless")])
        assert rviz_configuration(tmp_path / "x.yaml", scenario) == RVIZ / f"{expected}.rviz"


def test_none_of_its_own(tmp_path):
    nameless = load_scenario("rope_one_assistant", [("name", "nameless")])
    assert own_configuration(nameless) is None
    assert own_configuration(nameless, tmp_path / "x.yaml") is None
    own = own_configuration(load_scenario("rope_one_assistant"))
    assert own == RVIZ / "rope_one_assistant.rviz"
