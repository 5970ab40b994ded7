"""Objects pulled apart are recognised, and told wherever a run is told."""

import dataclasses
import json
import math

import numpy as np
import pytest

from deformable_manipulation.commands import plot_run, run_scenario
from deformable_manipulation.objects.fabric import FabricSpec
from deformable_manipulation.objects.rod import RodSpec
from deformable_manipulation.recording import read_run
from deformable_manipulation.scenario import load_scenario, package_share_directory
from deformable_manipulation.simulation.stretch import StretchGauge, largest_stretch, valid_stretch

SHORT_ROPE = package_share_directory() / "test" / "rostest" / "short_rope.yaml"
LINE = np.array([[0.0, 0.0, 0.0], [0.3, 0.4, 0.0], [0.3, 0.4, 0.5], [0.3, 0.9, 0.5]])


@pytest.mark.parametrize("change", [0.0, 0.2, -0.3])
def test_the_segment_changed_most_tells(change):
    points = LINE.copy()
    points[-1, 1] += 0.5 * change
    points[1:, 0] += 0.001
    rod = RodSpec(1.5, 0.01, 1000.0, 3, 1e7, 1e7)
    assert StretchGauge(rod).measure(points) == pytest.approx(change or 0.0012, rel=1e-2)


SQUARE = FabricSpec(
    vertices=((0.0, 0.0, 0.0), (0.5, 0.0, 0.0), (0.5, 0.5, 0.0), (0.0, 0.5, 0.0)),
    triangles=((0, 1, 2), (0, 2, 3)),
    density=2.0,
    thickness=0.001,
    stretching_compliance=1e-3,
    bending_compliance=1.0,
)


@pytest.mark.parametrize("change", [0.1, -0.1])
def test_the_edge_of_a_fabric_changed_most_tells(change):
    points = np.array(SQUARE.vertices)
    points[3] = [0.0, 0.0, 0.5 + 0.5 * change]  # folded up and pulled: two of five edges change
    stretched = np.linalg.norm(points[3] - points[2]) / 0.5 - 1.0
    largest = stretched if abs(stretched) > abs(change) else change
    assert StretchGauge(SQUARE).measure(points) == pytest.approx(largest)
    assert StretchGauge(SQUARE).measure(np.array(SQUARE.vertices) + 1.0) == pytest.approx(0.0)


def test_a_fabric_may_yield_by_ten_times_its_weight():
    scenario = load_scenario(SHORT_ROPE)
    assert valid_stretch(scenario) == 0.01
    fabric = dataclasses.replace(scenario, object=SQUARE)
    mean_length = (4 * 0.5 + math.sqrt(0.5)) / 5
    weight = 2.0 * 0.25 * 9.81
    assert valid_stretch(fabric) == pytest.approx(0.01 + 10 * 1e-3 * weight / mean_length)


def test_the_largest_of_a_run():
    assert largest_stretch(np.array([0.1, np.nan, -0.3, np.inf])) == 0.3
    assert largest_stretch(np.empty(0)) is None


def run(folder, *changes):
    options = [item for change in changes for item in ("--set", change)]
    arguments = [str(SHORT_ROPE), "--no-safety", "--output", str(folder)]
    assert run_scenario.main(arguments + ["--set", "simulation.duration=4"] + options) == 0
    return json.loads((folder / "summary.json").read_text())


def test_a_rope_as_long_as_it_should_be(tmp_path, capsys):
    summary = run(tmp_path)
    assert summary["shape_valid"]
    assert 0.0 < summary["max_stretch"] < 1e-4
    assert "WARNING" not in capsys.readouterr().out
    assert read_run(tmp_path).max_stretch == pytest.approx(summary["max_stretch"], rel=1e-9)


@pytest.fixture(scope="module")
def torn(tmp_path_factory):
    """A run whose leader goes 3 m away while the assistant hardly moves."""
    folder = tmp_path_factory.mktemp("torn")
    away = "leader.waypoints.1={time: 3.0, position: [0.0, -3.0, 0.0]}"
    return folder, run(folder, away, "controller.max_velocity=0.001")


def test_a_rope_torn_apart_is_told(torn, capsys):
    folder, summary = torn
    assert not summary["shape_valid"]
    assert summary["max_stretch"] > 0.5
    # 4.5 m between grips that 2.17 m of rope are to connect.
    with np.load(folder / "states.npz") as states:
        lengths = np.linalg.norm(np.diff(states["points"][-1], axis=0), axis=1)
    assert lengths.sum() > 4.0
    assert run_scenario.describe(summary).count("WARNING: the object was stretched") == 1


def test_plots_of_a_torn_rope_say_so(torn, monkeypatch):
    folder, _ = torn
    titles = []
    monkeypatch.setattr(
        "deformable_manipulation.plots.style.save_figure",
        lambda figure, path: titles.append(
            figure.legends[0].get_title().get_text() if figure.legends else figure.get_suptitle()
        ),
    )
    assert plot_run.main([str(folder), "--format", "png"]) == 0
    assert len(titles) == 2
    assert all("NOT VALID: object stretched by up to" in title for title in titles)


def test_folders_that_tell_no_stretch_are_read(torn, tmp_path):
    folder, _ = torn
    rows = (folder / "timeseries.csv").read_text().splitlines()
    column = rows[0].split(",").index("stretch")
    kept = [[cell for i, cell in enumerate(row.split(",")) if i != column] for row in rows]
    (tmp_path / "timeseries.csv").write_text("\n".join(",".join(row) for row in kept) + "\n")
    assert read_run(tmp_path).max_stretch is None


def test_what_is_valid_comes_from_the_summary(torn, tmp_path):
    folder, summary = torn
    (tmp_path / "timeseries.csv").write_text((folder / "timeseries.csv").read_text())
    assert read_run(tmp_path).valid_stretch == 0.01  # recorded by an earlier version
    (tmp_path / "summary.json").write_text(json.dumps(dict(summary, valid_stretch=0.07)))
    assert read_run(tmp_path).valid_stretch == 0.07
