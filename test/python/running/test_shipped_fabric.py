"""The fabric that comes with the package stays safe along its path, gone four times as fast."""

import json

import numpy as np
import pytest

from deformable_manipulation.commands import run_scenario
from deformable_manipulation.scenario import load_scenario

NAME = "fabric_three_assistants"
QUICKER = 4.0
SHORTFALL = 0.001  # m, tolerated at every limit


def run(folder, *options):
    """The content of summary.json of a run."""
    scenario = load_scenario(NAME)
    waypoints = [
        {"time": waypoint.time / QUICKER, "position": list(waypoint.position)}
        for waypoint in scenario.leader.waypoints
    ]
    duration = scenario.simulation.duration / QUICKER
    arguments = ["--set", f"leader.waypoints={json.dumps(waypoints)}"]
    arguments += ["--set", f"simulation.duration={duration:g}", "--output", str(folder)]
    assert run_scenario.main([NAME, *arguments, *options]) == 0
    return json.loads((folder / "summary.json").read_text())


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp(NAME)


@pytest.fixture(scope="module")
def summary(folder):
    return run(folder)


def test_no_limit_is_violated(summary):
    assert summary["completed"] and summary["shape_valid"]
    assert summary["min_distance"] >= summary["offset"] - SHORTFALL
    assert summary["min_margin"]["overstretch"] >= -SHORTFALL
    assert summary["min_margin"]["proximity"] >= -SHORTFALL
    assert summary["qp_failed"] == 0


def test_both_limits_are_met(summary):
    """The fabric comes as near as it may, and is drawn as taut as it may be for that."""
    assert summary["min_distance"] < summary["offset"] + 0.012  # a margin of 0.01 m
    assert summary["min_margin"]["overstretch"] < 0.01
    errors = summary["tracking_error"].values()
    assert max(error["max"] for error in errors) > 0.1


def test_the_assistants_are_back_at_their_places_in_the_end(summary):
    assert max(error["final"] for error in summary["tracking_error"].values()) < 0.001


def test_the_fabric_hangs_between_its_corners_all_the_time(summary, folder):
    with np.load(folder / "states.npz") as states:
        points, agents = states["points"], states["agents"]
    np.testing.assert_allclose(points[:, [0, 14, 210, 224]], agents, atol=1e-5)
    assert (points[:, 112, 2] < agents[:, :, 2].min(axis=1)).all()  # the middle, below them


def test_the_fabric_hits_the_cube_without_the_barriers(tmp_path):
    unsafe = run(tmp_path, "--no-safety", "--set", "controller.rate=10")
    assert not unsafe["safety"]
    assert unsafe["min_distance"] < -0.05
