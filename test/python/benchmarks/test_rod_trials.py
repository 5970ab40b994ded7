"""The trial that every library goes through, and its error against theory."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from deformable_manipulation.benchmarks import rod_comparison
from deformable_manipulation.benchmarks.harness import Effort
from deformable_manipulation.benchmarks.package_rod import PackageRod
from deformable_manipulation.benchmarks.rivals.catalogue import ROD_RIVALS
from deformable_manipulation.benchmarks.rod_case import CANTILEVER, ROPE
from deformable_manipulation.benchmarks.rod_comparison import make_case
from deformable_manipulation.benchmarks.rod_model import UndampedRodModel
from deformable_manipulation.benchmarks.rod_theory import error_of
from deformable_manipulation.benchmarks.subject import Request
from deformable_manipulation.benchmarks.trial import (
    DRAW_IN,
    SETTLED,
    Trial,
    TrialError,
    run_trial,
)
from deformable_manipulation.validation.references.elastica import (
    Pinned,
    solve_between,
    solve_cantilever,
)

EFFORT = Effort(repetitions=1, least_time=1e-6)
RATE = 4.0  # 1/s
AMPLITUDE = 0.5  # m


class FadingModel(UndampedRodModel):
    """One point that comes down exponentially; its damping is the driver's business."""

    time_step = 0.004
    free_length = 2.0
    settings = "fading"

    def __init__(self, rate=RATE):
        self.steps = 0
        self.factors = []
        self.ends = []
        self._rate = rate

    def advance(self, count):
        self.steps += count

    def damp(self, factor):
        self.factors.append(factor)

    def place_end(self, x, velocity):
        self.ends.append((x, velocity))

    def points(self):
        return np.array([[0.0, AMPLITUDE * np.exp(-self._rate * self.steps * self.time_step)]])

    def arc_lengths(self):
        return np.array([1.0])


def test_settling_time_is_the_last_time_away_from_rest():
    trial = run_trial(FadingModel(), make_case(CANTILEVER, 28), EFFORT)
    assert trial.settling_time == pytest.approx(np.log(AMPLITUDE / SETTLED) / RATE, abs=0.03)
    assert trial.points[0][1] < 1e-5


def test_a_model_that_never_rests_has_no_settling_time():
    slow = FadingModel(rate=1e-3)
    trial = run_trial(slow, make_case(CANTILEVER, 28), EFFORT, time_limit=2.0)
    assert trial.settling_time is None


def test_the_held_end_is_drawn_in_step_by_step():
    case, model = make_case(ROPE, 28), FadingModel()
    run_trial(model, case, EFFORT)
    places = np.array([x for x, _ in model.ends])
    assert len(places) == round(DRAW_IN / model.time_step) + 1
    assert places[-1] == case.span and model.ends[-1][1] == 0.0
    np.testing.assert_allclose(
        np.diff(places[:-1]), model.time_step * np.array([v for _, v in model.ends[1:-1]])
    )


def test_every_untimed_step_is_damped():
    case, model = make_case(CANTILEVER, 28), FadingModel()
    trial = run_trial(model, case, Effort(1, 1e-9))
    timed = model.steps - len(model.factors)
    assert timed > 0 and len(model.factors) * model.time_step > trial.settling_time
    assert set(model.factors) == {np.exp(-case.damping * model.time_step)}


def test_a_state_that_breaks_down_is_an_error():
    with pytest.raises(TrialError, match="finite"):
        run_trial(FadingModel(rate=float("nan")), make_case(CANTILEVER, 28), EFFORT)


def trial_at(points, arcs, free_length, overhang=0.0):
    measures = {"arc_lengths": arcs.tolist(), "free_length": free_length, "overhang": overhang}
    return Trial(points.tolist(), 0.01, "exact", 1.0, [1e-6], measures)


def test_the_error_of_the_exact_rope_is_zero_and_of_another_what_it_is_off():
    case = make_case(ROPE, 28)
    free = case.length - case.segment_length
    grip = Pinned(0.5 * case.segment_length)
    theory = solve_between(
        free, case.bending_stiffness, case.weight_per_length, (case.span, 0.0), grip, grip
    )
    arcs = np.linspace(0.0, free, 28)
    points = theory.positions(arcs)
    assert error_of(trial_at(points, arcs, free, grip.overhang), case) < 1e-12
    points[9] += (0.003, -0.004)
    error = error_of(trial_at(points, arcs, free, grip.overhang), case)
    assert error == pytest.approx(0.005 / case.length)


def test_the_error_of_a_cantilever_is_that_of_its_drop():
    case = make_case(CANTILEVER, 28)
    arcs = np.linspace(0.0, case.length, 5)
    theory = solve_cantilever(case.length, case.bending_stiffness, case.weight_per_length)
    points = theory.positions(arcs) * (1.0, 1.02)
    assert error_of(trial_at(points, arcs, case.length), case) == pytest.approx(0.02)


@pytest.mark.parametrize("load, bound", [(ROPE, 5e-4), (CANTILEVER, 1e-3)])
def test_the_package_s_own_rods_rest_where_theory_says(load, bound):
    case = make_case(load, 28)
    alone, with_copies = (
        run_trial(PackageRod(case, "direct", "zero", copies), case, EFFORT) for copies in (1, 4)
    )
    assert abs(error_of(alone, case)) < bound
    np.testing.assert_allclose(with_copies.points, alone.points, atol=1e-5)
    assert alone.settling_time < 10.0


def test_a_trial_survives_the_way_between_interpreters():
    trial = run_trial(FadingModel(), make_case(CANTILEVER, 28), EFFORT)
    assert Trial(**dataclasses.asdict(trial)) == trial


def test_a_rod_of_the_package_that_breaks_down_is_a_row_like_any_other(monkeypatch):
    # So heavy that its state overflows.
    heavy = dataclasses.replace(make_case(ROPE, 28), gravity=1e300)
    monkeypatch.setattr(rod_comparison, "_cases", lambda quick: [heavy])
    request = Request(True, Path("nowhere"), lambda what: None)
    rows = rod_comparison.comparison_table(request).rows
    assert len(rows) == len(rod_comparison.OWN) + len(ROD_RIVALS)
    for row in rows:
        assert "median_us" not in row and row["remark"].startswith(("failed", "not installed"))
