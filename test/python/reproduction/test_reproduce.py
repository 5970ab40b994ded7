"""The report of a scenario, as the command makes it."""

import re

import pytest

from deformable_manipulation.commands import reproduce
from deformable_manipulation.reproduction.paper import PUBLISHED
from deformable_manipulation.scenario import scenario_names


@pytest.fixture(scope="module")
def report(tmp_path_factory):
    folder = tmp_path_factory.mktemp("report") / "out"
    status = reproduce.main(
        ["rope_one_assistant", "--no-pictures", "--campaign-runs", "0", "--output", str(folder)]
    )
    assert status == 0
    return (folder / reproduce.REPORT).read_text(encoding="utf-8")


def cells(report, *row_start):
    """The cells of the row that begins with the given ones."""
    start = "".join(f"<td>{cell}</td>" for cell in row_start)
    (row,) = re.findall(re.escape("<tr>" + start) + "(.*)</tr>", report)
    return re.findall("<td>(.*?)</td>", row)


def test_the_filter_keeps_the_offset_and_without_it_the_rope_hits_the_ground(report):
    row = cells(report, "rope_one_assistant", "full formulation")
    offset, lowest = (float(cell) for cell in row[:2])
    assert lowest > offset - 1.0
    assert float(cells(report, "rope_one_assistant", "safety filter off")[1]) < 0.0


def test_the_papers_distance_stands_beside(report):
    paper = cells(report, "rope_one_assistant", "reported in the paper")
    assert paper[:2] == ["50.0", "31.0"]


def test_times_stand_beside_the_papers(report):
    paper = cells(report, "rope_one_assistant", "paper, average")
    assert [float(cell) for cell in paper] == list(PUBLISHED["rope_one_assistant"].times)
    assert all(float(cell) > 0.0 for cell in cells(report, "rope_one_assistant", "here, median"))


def test_pictures_are_within_the_page(report):
    assert report.count('src="data:image/png;base64,') == 2  # overview and the controller's
    assert not re.search(r'src="(?!data:)', report)


def test_pictures_have_captions(report):
    overview, controller = re.findall("<figcaption>(.*?)</figcaption>", report)
    assert overview.startswith("The whole run") and "assistant_1 saw and did" in controller


def test_the_papers_scenarios_come_first():
    assert set(scenario_names()[:4]) >= set(PUBLISHED)


def test_unknown_scenario(capsys, tmp_path):
    assert reproduce.main(["rope", "--output", str(tmp_path / "out")]) == 1
    assert "no scenario 'rope'; allowed: rope_one_assistant" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_nothing_is_overwritten(capsys, tmp_path):
    (tmp_path / "notes").touch()
    assert reproduce.main(["--output", str(tmp_path)]) == 1
    assert "not empty; choose another --output" in capsys.readouterr().err


def test_mistaken_values(capsys, tmp_path):
    status = reproduce.main(["--set", "controller.gain=-1", "--output", str(tmp_path / "out")])
    assert status == 1
    assert "controller.gain" in capsys.readouterr().err
