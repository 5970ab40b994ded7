"""The cloth that every library simulates, and its error at rest."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from deformable_manipulation.benchmarks import fabric_comparison
from deformable_manipulation.benchmarks.fabric_case import UndampedFabricModel
from deformable_manipulation.benchmarks.fabric_comparison import contest, error_of
from deformable_manipulation.benchmarks.harness import Effort
from deformable_manipulation.benchmarks.package_fabric import PART, SIZE, PackageFabric, make_case
from deformable_manipulation.benchmarks.rivals.catalogue import FABRIC_RIVALS
from deformable_manipulation.benchmarks.subject import Request
from deformable_manipulation.benchmarks.trial import DRAW_IN, Trial, run_trial

EFFORT = Effort(repetitions=1, least_time=1e-6)


class StillModel(UndampedFabricModel):
    """A cloth that only its held vertices move."""

    time_step = 0.004
    settings = "still"

    def __init__(self, case):
        self.held = case.held
        self.places = np.array(case.vertices)
        self.way = []

    def advance(self, count):
        pass

    def damp(self, factor):
        pass

    def place_held(self, positions, velocities):
        self.places[self.held] = positions
        self.way.append((positions, velocities))

    def points(self):
        return self.places


def test_the_corners_are_drawn_in_step_by_step():
    case = make_case(5)
    model = StillModel(case)
    trial = run_trial(model, case, EFFORT)
    places = np.array([positions for positions, _ in model.way])
    assert len(places) == round(DRAW_IN / model.time_step) + 1
    np.testing.assert_allclose(places[-1], PART * np.array(case.vertices)[case.held])
    assert np.abs(model.way[-1][1]).max() == 0.0
    steps = model.time_step * np.array([velocities for _, velocities in model.way[1:-1]])
    np.testing.assert_allclose(np.diff(places[:-1], axis=0), steps, atol=1e-12)
    assert trial.settling_time == pytest.approx(DRAW_IN, abs=0.03)


def test_the_case_has_the_mass_and_the_folds_of_the_cloth():
    case = make_case(4)
    assert sum(case.masses) == pytest.approx(case.density * SIZE**2)
    hinges = case.hinges()
    assert len(hinges) == 9 + 2 * 2 * 3  # diagonals, and edges inside
    for one, other, *edge in hinges:
        for corner in (one, other):
            assert sorted((corner, *edge)) in [sorted(triangle) for triangle in case.triangles]
    assert len(case.edges) == len(hinges) + 4 * 3 and min(case.springs) > 0.0


def test_the_error_is_the_distance_from_the_equilibrium():
    cloth = contest(6)
    trial = run_trial(cloth.own[-1].model(), cloth.case, EFFORT)
    assert error_of(trial, cloth.case) < 0.01
    moved = np.array(trial.points)
    moved[14] += (0.0, 0.003, 0.004)
    off = Trial(moved.tolist(), trial.time_step, "moved", 1.0)
    assert error_of(off, cloth.case) == pytest.approx(0.005 / SIZE, rel=0.2)


def test_copies_leave_the_cloth_where_it_is():
    case = make_case(6)
    alone, with_copies = (
        run_trial(PackageFabric(case, 0.001, copies), case, EFFORT) for copies in (1, 4)
    )
    np.testing.assert_allclose(with_copies.points, alone.points, atol=1e-6)
    assert alone.settling_time < 10.0


def test_a_cloth_of_the_package_that_breaks_down_is_a_row_like_any_other(monkeypatch):
    # So heavy that its state overflows.
    heavy = dataclasses.replace(make_case(5), gravity=1e300)
    monkeypatch.setattr(fabric_comparison, "make_case", lambda particles: heavy)
    request = Request(True, Path("nowhere"), lambda what: None)
    rows = fabric_comparison.comparison_table(request).rows
    assert len(rows) == len(fabric_comparison.OWN) + len(FABRIC_RIVALS)
    for row in rows:
        assert "median_us" not in row and row["remark"].startswith(("failed", "not installed"))
