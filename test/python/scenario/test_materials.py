"""Material presets in the scenario file, and their page."""

import copy

import pytest

from deformable_manipulation.objects import materials
from deformable_manipulation.objects.kinds import KINDS
from deformable_manipulation.objects.materials import NOTES, preset_values, presets
from deformable_manipulation.scenario import (
    package_share_directory,
    scenario_from_mapping,
    scenario_to_mapping,
)

ALL = [(kind, name) for kind in KINDS for name in presets(kind)]
GIVEN = {
    "rod": ("radius", "density", "young_modulus", "torsion_modulus"),
    "fabric": ("density", "thickness", "stretching_compliance", "bending_compliance"),
}


@pytest.fixture
def made_of(mapping, fabric_mapping):
    """Function: a correct scenario whose object leaves its material to a preset."""

    def made_of(kind, name):
        scenario = copy.deepcopy({"rod": mapping, "fabric": fabric_mapping}[kind])
        for key in GIVEN[kind]:
            del scenario["object"][key]
        scenario["object"]["material"] = name
        return scenario

    return made_of


@pytest.mark.parametrize("kind, name", ALL)
def test_a_preset_gives_all_values(made_of, tmp_path, kind, name):
    assert set(presets(kind)[name]) == {*GIVEN[kind], *NOTES}
    spec = scenario_from_mapping(made_of(kind, name), tmp_path).object
    assert {key: getattr(spec, key) for key in GIVEN[kind]} == preset_values(kind, name)


def test_keys_of_the_scenario_go_before(made_of, tmp_path):
    mapping = made_of("rod", "steel_rod")
    mapping["object"]["radius"] = 0.003
    scenario = scenario_from_mapping(mapping, tmp_path)
    assert (scenario.object.radius, scenario.object.density) == (0.003, 7850.0)
    assert scenario_from_mapping(scenario_to_mapping(scenario), tmp_path) == scenario


@pytest.mark.parametrize(
    "kind, value, expected",
    [
        ("rod", "hemp_rop", "did you mean 'hemp_rope'? known: hemp_rope, nylon_rope"),
        ("rod", "cotton", "it is a material of type fabric; known: hemp_rope"),
        ("fabric", "steel_rod", "it is a material of type rod; known: cotton"),
        ("rod", 3, "is not a known material of type rod"),
        ("rod", ["cotton"], "is not a known material of type rod"),
    ],
)
def test_unknown_materials_are_told_with_all_other_mistakes(
    made_of, problems_of, kind, value, expected
):
    mapping = made_of(kind, value)
    assert list(problems_of(mapping)) == ["object.material"]
    mapping["object"]["damping"] = -1
    found = problems_of(mapping)
    assert set(found) == {"object.material", "object.damping"}
    assert expected in found["object.material"]


def test_a_kind_may_have_no_presets(made_of, problems_of, monkeypatch):
    monkeypatch.setattr(materials, "presets", lambda kind: {})
    found = problems_of(made_of("rod", "hemp_rope"))
    assert "known: none; remove it" in found["object.material"]
    assert presets("a kind without a file") == {}


@pytest.fixture(scope="module")
def rows():
    """Rows of the page's tables: material -> cells."""
    page = (package_share_directory() / "docs" / "materials.md").read_text(encoding="utf-8")
    page = page.split("### How well they are carried")[0]
    lines = [line.strip("|\n").split("|") for line in page.splitlines() if line[:3] == "| `"]
    return {cells[0].strip(" `"): [cell.strip() for cell in cells[1:]] for cells in lines}


@pytest.mark.parametrize("kind, name", ALL)
def test_the_page_has_every_preset_with_its_values(rows, kind, name):
    preset = presets(kind)[name]
    about, *numbers = rows[name][: 1 + len(GIVEN[kind])]
    assert about == preset["about"]
    assert [float(number) for number in numbers] == [preset[key] for key in GIVEN[kind]]
    assert rows[name][-1] == preset["source"]


def test_the_page_has_no_other_presets(rows):
    parameters = {"material", *GIVEN["rod"], *GIVEN["fabric"]}
    assert set(rows) - parameters == {name for _, name in ALL}
