"""docs/parameters.md has a table for every section, made of the declared parameters."""

import dataclasses

import pytest

from deformable_manipulation.reading.parameter import declared, declared_below
from deformable_manipulation.scenario import parameters_page
from deformable_manipulation.scenario.barriers import BARRIERS
from deformable_manipulation.scenario.live import live_parameters
from deformable_manipulation.scenario.parameters_page import main, sections, updated
from deformable_manipulation.scenario.spec import Scenario
from deformable_manipulation.system.package_files import package_share_directory


@pytest.fixture(scope="module")
def page():
    return (package_share_directory() / "docs" / "parameters.md").read_text(encoding="utf-8")


def test_the_page_is_up_to_date(page):
    assert updated(page) == page, "run scripts/parameters_page"
    assert main(["--check"]) == 0


def test_a_changed_declaration_shows(page):
    assert updated(page.replace("k_p: how fast", "k_p: how slowly")) == page
    assert updated(page.replace("Keeps the agents apart.", "")) == page


def test_every_barrier_has_its_section_and_its_page(page):
    for name, kind in BARRIERS.items():
        assert f"### controller.{name}\n\n{kind.meaning}" in page


@pytest.mark.parametrize("lost", ["### leader.workspace", "<!-- barriers: made by"])
def test_a_section_without_a_place_is_told(page, lost):
    with pytest.raises(ValueError, match="leader.workspace|barriers"):
        updated(page.replace(lost, "### elsewhere"))


def test_the_command_tells_what_to_write(page, tmp_path, monkeypatch, capsys):
    share = tmp_path / "docs" / "parameters.md"
    share.parent.mkdir()
    share.write_text(page.replace("### leader.workspace", "### elsewhere"), encoding="utf-8")
    monkeypatch.setattr(parameters_page, "package_share_directory", lambda: tmp_path)
    assert main([]) == 1
    told = capsys.readouterr().err
    assert "no table below the heading 'leader.workspace': write the heading" in told


def test_every_section_of_the_scenario_is_on_the_page():
    """Those that are read below the top level, by their specs."""
    shown = {getattr(section, "spec", None) for section in sections().values()}
    shown |= {kind.spec for kind in BARRIERS.values()}
    for path, declaration in declared_below(Scenario):
        below = getattr(declaration.reader, "spec", None)
        assert below is None or below in shown, path


def test_every_key_is_declared_with_a_meaning():
    specs = [section.spec for section in sections().values() if hasattr(section, "spec")]
    for spec in [*specs, *(kind.spec for kind in BARRIERS.values())]:
        declarations = {attribute for attribute, _ in declared(spec).values()}
        undeclared = {field.name for field in dataclasses.fields(spec)} - declarations
        assert undeclared <= {"name", "vertices", "triangles", "mended"}, (spec, undeclared)
        for key, (_, declaration) in declared(spec).items():
            assert declaration.meaning.endswith("."), (spec, key)


def test_live_names_are_unique_and_ranges_hold_the_defaults():
    names = [name for _, declaration in live_parameters() for name in declaration.live.names]
    assert len(names) == len(set(names))
    for path, declaration in live_parameters():
        assert declaration.live.least < declaration.live.most, path
