"""The whole chain in one process, on a short run of a small fabric over a cube."""

import json

import numpy as np
import pytest

from deformable_manipulation.commands import plot_run, run_scenario
from deformable_manipulation.recording import read_run
from deformable_manipulation.scenario import load_scenario, package_share_directory

SMALL_FABRIC = package_share_directory() / "test" / "rostest" / "small_fabric.yaml"
TOLERATED = 0.001  # m short of the offset


def run(folder, *options):
    """The content of summary.json of a run."""
    assert run_scenario.main([str(SMALL_FABRIC), "--output", str(folder), *options]) == 0
    return json.loads((folder / "summary.json").read_text())


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("fabric")


@pytest.fixture(scope="module")
def summary(folder):
    return run(folder)


def test_the_filter_keeps_the_fabric_off_the_cube(summary):
    assert summary["completed"] and summary["safety"]
    assert summary["offset"] - TOLERATED <= summary["min_distance"] < summary["offset"] + 0.025
    assert summary["min_margin"]["overstretch"] > -TOLERATED
    assert summary["qp_failed"] == 0


def test_the_fabric_would_go_into_the_cube_without_it(tmp_path):
    deeper = "leader.waypoints.1.position=[0.0, 0.0, -0.3]"
    unsafe = run(tmp_path, "--no-safety", "--set", "controller.rate=50", "--set", deeper)
    assert unsafe["min_distance"] < -0.02


def test_the_fabric_stays_as_large_as_its_material_makes_it(summary, folder):
    assert summary["shape_valid"]
    assert 0.0 < summary["max_stretch"] < summary["valid_stretch"] < 0.03
    assert read_run(folder).valid_stretch == summary["valid_stretch"]


def test_frames_have_points_and_triangles(folder, summary):
    fabric = load_scenario(SMALL_FABRIC).object
    with np.load(folder / "states.npz") as states:
        assert states["points"].shape == (40, 25, 3)
        np.testing.assert_array_equal(states["faces"], fabric.triangles)
        corners = states["points"][-1, [0, 4, 20, 24]]
        np.testing.assert_allclose(states["agents"][-1], corners, atol=1e-6)


def test_plots_of_every_assistant(folder, summary, tmp_path, capsys):
    assert plot_run.main([str(folder), "--output", str(tmp_path)]) == 0
    names = ["controller_assistant_{}.png".format(number) for number in (1, 2, 3)]
    made = sorted(path.name for path in tmp_path.iterdir() if path.suffix == ".png")
    assert made == names + ["overview.png"]
