"""The scenarios that come with the package keep what they are to show, over their whole length."""

import json

import numpy as np
import pytest

from deformable_manipulation.commands import run_scenario
from deformable_manipulation.scenario import load_scenario
from deformable_manipulation.scenario.spec import PolygonObstacle

SHORTFALL = 0.001  # m, tolerated at every limit
SCENARIOS = (
    "rope_one_assistant",
    "stiff_rod_one_assistant",
    "rope_two_assistants",
    "rope_moving_obstacle",
    "tent_pole_one_assistant",
    "hose_two_assistants",
)


def run(name, folder, *options):
    """The content of summary.json of a run."""
    assert run_scenario.main([name, "--output", str(folder), *options]) == 0
    return json.loads((folder / "summary.json").read_text())


@pytest.fixture(scope="module", params=SCENARIOS)
def name(request):
    return request.param


@pytest.fixture(scope="module")
def folder(name, tmp_path_factory):
    return tmp_path_factory.mktemp(name)


@pytest.fixture(scope="module")
def summary(name, folder):
    return run(name, folder)


def test_no_limit_is_violated(summary):
    assert summary["completed"] and summary["safety"]
    assert summary["min_distance"] >= summary["offset"] - SHORTFALL
    assert min(summary["min_margin"].values()) >= -SHORTFALL
    assert summary["qp_relaxed"] == summary["qp_failed"] == 0


def test_the_barrier_is_needed_and_not_overdone(summary):
    """The object comes as near as it may, and the assistants leave their places for that."""
    assert summary["min_distance"] < summary["offset"] + 0.005
    assert min(error["max"] for error in summary["tracking_error"].values()) > 0.1


def test_the_assistants_are_back_at_their_places_in_the_end(summary):
    assert max(error["final"] for error in summary["tracking_error"].values()) < 0.001


def test_the_object_keeps_its_length_and_its_plane(name, summary, folder):
    with np.load(folder / "states.npz") as states:
        points = states["points"].astype(float)
    lengths = np.linalg.norm(np.diff(points, axis=1), axis=2)
    scenario = load_scenario(name)
    rod = scenario.object
    np.testing.assert_allclose(lengths, [rod.segment_lengths] * len(lengths), rtol=1e-4)
    # A block that turns below the rope drives it out of its plane.
    if all(isinstance(obstacle, PolygonObstacle) for obstacle in scenario.obstacles):
        assert np.abs(points[..., 0]).max() < 1e-6


def test_the_object_hits_the_obstacle_without_the_barriers(name, tmp_path):
    # Follows the leader alone, for which a fifth of the commands will do.
    unsafe = run(name, tmp_path, "--no-safety", "--set", "controller.rate=20")
    assert not unsafe["safety"]
    assert unsafe["min_distance"] < -0.1
