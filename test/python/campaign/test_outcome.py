"""What a campaign counts in a run, on tables whose content is known."""

import dataclasses
import math

import numpy as np
import pytest
from synthetic_run import make_record, make_scenario

from deformable_manipulation.campaign.outcome import assess, oscillation
from deformable_manipulation.campaign.report import describe, is_acceptable, summarise
from deformable_manipulation.campaign.runs import SeriesRecorder
from deformable_manipulation.control.status import Status
from deformable_manipulation.obstacles.primitives import Sphere, SphereObstacle

RATE = 100.0


def sine(frequency, amplitude, seconds=20.0):
    time = np.arange(int(seconds * RATE)) / RATE
    return amplitude * np.sin(2.0 * math.pi * frequency * time)


@pytest.mark.parametrize("frequency, share", [(0.1, 0.0), (0.3, 0.0), (5.0, 1.0), (20.0, 1.0)])
def test_only_what_is_faster_than_one_hertz_oscillates(frequency, share):
    values = 0.05 + sine(frequency, 0.002)
    rms = oscillation(values, np.ones(len(values), bool), RATE)
    assert rms == pytest.approx(share * 0.002 / math.sqrt(2.0), abs=1e-4)


def test_oscillation_outside_the_chosen_samples_does_not_count():
    values = sine(5.0, 0.002)
    where = np.zeros(len(values), bool)
    where[:1000] = True
    values[:1000] = 0.05
    assert oscillation(values, where, RATE) < 1e-9


def test_no_samples_no_oscillation():
    assert oscillation(sine(5.0, 0.1), np.zeros(2000, bool), RATE) == 0.0
    assert oscillation(np.full(2000, np.inf), np.ones(2000, bool), RATE) == 0.0


class Run:
    """A table of a run at rest in free space, to be changed by the test."""

    def __init__(self, folder, seconds=8.0):
        self.scenario = make_scenario(folder)
        recorder = SeriesRecorder(self.scenario)
        for cycle in range(int(seconds * self.scenario.controller.rate)):
            recorder.record(make_record(self.scenario, cycle))
        self.series = recorder.series
        self.set("distance", 1.0)
        for agent in self.scenario.agents:
            for axis in "xyz":
                self.set(f"{agent.name}.velocity_{axis}", 0.0)
        for name in self.series.assistants:
            self.set(f"{name}.error_norm", 0.0)
            self.set(f"{name}.status", Status.NOMINAL)
            for barrier in self.series.barriers:
                self.set(f"{name}.h_{barrier}", 0.2)

    def set(self, column, value, where=slice(None)):
        self.series.column(column)[where] = value  # a view of the table

    def assess(self):
        return assess(self.scenario, self.series)


@pytest.fixture
def run(tmp_path):
    return Run(tmp_path)


def test_the_true_distance_counts_where_the_controllers_do_not_know_the_obstacles(run):
    offset = run.scenario.controller.collision.offset
    run.set("distance", offset - 0.003, slice(10, 11))
    assert run.assess().violations["collision"] == 0.0  # as they know it
    hidden = SphereObstacle("ball", Sphere(0.1), known=False)
    run.scenario = dataclasses.replace(run.scenario, obstacles=(hidden,))
    assert run.assess().violations["collision"] == pytest.approx(0.003)


def test_what_is_not_known_yet_is_no_error(run):
    for name in run.series.assistants:
        run.set(f"{name}.error_norm", math.nan, slice(1))
    outcome = run.assess()
    assert outcome.tracking_error == outcome.final_error == 0.0


def test_a_run_in_which_nothing_happens(run):
    outcome = run.assess()
    assert outcome.completed and not outcome.deadlock
    assert set(outcome.violations.values()) == {0.0}
    assert outcome.relaxed == outcome.failed == 0 and outcome.constrained == 0.0


def test_violations_are_how_far_the_limits_are_missed(run):
    name = run.series.assistants[0]
    run.set(f"{name}.h_collision", -0.004, 5)
    run.set(f"{name}.h_overstretch", -0.002, 6)
    run.set(f"{name}.h_proximity", -0.003, 7)
    outcome = run.assess()
    assert outcome.violations == pytest.approx(
        {"collision": 0.004, "overstretch": 0.002, "proximity": 0.003}
    )


def test_programs_are_counted(run):
    name = run.series.assistants[0]
    run.set(f"{name}.status", Status.RELAXED, slice(10, 13))
    run.set(f"{name}.status", Status.FAILED, 20)
    outcome = run.assess()
    assert (outcome.relaxed, outcome.failed) == (3, 1)


def test_an_assistant_that_stays_away_with_nothing_in_the_way_is_deadlocked(run):
    run.set(f"{run.series.assistants[0]}.error_norm", 0.06)
    assert run.assess().deadlock


def test_it_is_none_while_the_leader_moves_or_something_is_in_the_way_or_it_comes_back(run):
    name = run.series.assistants[0]
    leader = run.scenario.agents[run.scenario.leader_index].name
    run.set(f"{name}.error_norm", 0.06)
    run.set(f"{leader}.velocity_y", 0.01, -50)
    assert not run.assess().deadlock
    run.set(f"{leader}.velocity_y", 0.0)
    run.set("distance", run.scenario.controller.collision.offset + 0.01, -50)
    assert not run.assess().deadlock
    run.set("distance", 1.0)
    run.set(f"{name}.error_norm", 0.04, slice(-10, None))
    assert not run.assess().deadlock


def test_errors_count_as_tracking_only_long_after_a_constraint(run):
    name = run.series.assistants[0]
    run.set(f"{name}.error_norm", 0.01, slice(0, 100))
    run.set(f"{name}.error_norm", 0.3, slice(100, None))
    run.set(f"{name}.status", Status.CONSTRAINED, 100)
    assert run.assess().tracking_error == pytest.approx(0.01)


def test_a_run_that_broke_down_says_why(run):
    outcome = assess(run.scenario, run.series, 3, "the state is not finite")
    assert not outcome.completed and outcome.index == 3
    assert outcome.problem == "the state is not finite"


def test_an_assistant_that_waits_for_most_of_a_run(tmp_path):
    run = Run(tmp_path)
    status = run.series.column("assistant_1.status")
    status[: len(status) // 4] = Status.WAITING
    assert (run.assess().waiting, run.assess().waits) == (0.25, False)
    status[:] = Status.WAITING
    outcome = run.assess()
    assert (outcome.waiting, outcome.waits) == (1.0, True)
    summary = summarise([outcome], 0.001)
    assert not is_acceptable(summary)
    assert "waiting               1 runs" in describe(summary)
