import numpy as np
import pytest

from deformable_manipulation.control.decision import Decision
from deformable_manipulation.control.status import Status
from deformable_manipulation.cycles.health import (
    CycleMonitor,
    DecisionMonitor,
    Level,
    input_report,
)

RATE = 100.0


class Clock:
    now = 10.0

    def __call__(self):
        return self.now


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture
def cycles(clock):
    return CycleMonitor(RATE, clock)


def answer(monitor, clock, count, latency=0.002, duration=0.001, seconds=1.0):
    for _ in range(count):
        clock.now += seconds / count
        monitor.answered(duration, latency)


def test_in_time(cycles, clock):
    answer(cycles, clock, 100)
    report = cycles.report()
    assert report.level is Level.OK
    assert report.text == "Answers 100 states per second in time."
    assert report.values["states per second"] == "100.0"
    assert report.values["latency [ms], median"] == "2.000"
    assert report.values["computation [ms], largest"] == "1.000"


@pytest.mark.parametrize("count, level", [(95, Level.OK), (80, Level.WARN), (30, Level.ERROR)])
def test_slow(cycles, clock, count, level):
    answer(cycles, clock, count)
    report = cycles.report()
    assert report.level is level
    if level is not Level.OK:
        assert report.text == f"Answers {count} states per second instead of 100."


def test_late(cycles, clock):
    answer(cycles, clock, 99, seconds=0.99)
    answer(cycles, clock, 1, latency=0.011, seconds=0.01)
    report = cycles.report()
    assert (report.level, report.text) == (Level.WARN, "1 of 100 answers took longer than a cycle.")
    answer(cycles, clock, 100, latency=0.02)
    report = cycles.report()
    assert report.level is Level.ERROR
    assert report.values["answers that took longer than a cycle, total"] == "101"
    answer(cycles, clock, 100)
    assert cycles.report().level is Level.OK


def test_silent(cycles, clock):
    answer(cycles, clock, 100)
    cycles.report()
    clock.now += 3.2
    report = cycles.report()
    assert report.level is Level.STALE
    assert report.text.startswith("No state for 3.2 s")


def test_a_state_that_cannot_be_answered(cycles):
    cycles.failed("State 3 cannot be used: agents: without leader.")
    report = cycles.report()
    assert (report.level, report.text) == (
        Level.ERROR,
        "State 3 cannot be used: agents: without leader.",
    )
    assert cycles.report().level is Level.STALE


def test_in_lock_step_any_rate_is_right(clock):
    monitor = CycleMonitor(None, clock)
    answer(monitor, clock, 7, latency=5.0)
    report = monitor.report()
    assert report.level is Level.OK
    assert "lock-step" in report.text
    assert "latency [ms], median" not in report.values


def decision(status, **fields):
    known = dict(position=np.zeros(3), target=np.zeros(3), error=np.array((0.0, 0.3, 0.4)))
    barriers = ("collision", "overstretch", "proximity")
    known["slack"] = {**dict.fromkeys(barriers, 0.0), **fields.pop("slack", {})}
    return Decision(status, status.sentence, True, np.zeros(3), **{**known, **fields})


def report_on(*decisions):
    monitor = DecisionMonitor()
    for each in decisions:
        monitor.decided(each)
    return monitor.report()


def test_decisions_in_order():
    report = report_on(
        decision(Status.NOMINAL, h={"collision": 0.2}, distance=0.25),
        decision(
            Status.CONSTRAINED, h={"collision": 0.1}, distance=0.15, rows=4, exact_jacobian=True
        ),
    )
    assert report.level is Level.OK
    assert "in 1 of 2 cycles; all limits hold" in report.text
    assert report.values["lowest h, collision [m]"] == "0.1000"
    assert report.values["lowest h, proximity [m]"] == "unknown"
    assert report.values["error at the end [m]"] == "0.5000"
    assert report.values["cycles with exact gradients"] == "1 of 2"
    assert report.values["constraints, at most"] == "4"


def test_limits_that_are_missed_are_told_with_their_slack():
    report = report_on(
        decision(Status.RELAXED, slack={"collision": 0.002, "overstretch": 0.0001}),
        decision(Status.NOMINAL),
    )
    assert report.level is Level.WARN
    assert report.text == (
        "Not all limits could hold in 1 of 2 cycles: collision missed by 2.00 mm/s at most, "
        "overstretch missed by 0.10 mm/s at most."
    )


@pytest.mark.parametrize(
    "statuses, level, text",
    [
        ([Status.FAILED, Status.RELAXED, Status.NOMINAL], Level.ERROR, "had no solution"),
        ([Status.NOMINAL, Status.WAITING], Level.ERROR, "Waits for valid input"),
        ([Status.WAITING, Status.NOMINAL], Level.WARN, "in 1 of 2 cycles"),
        ([Status.DISABLED], Level.OK, "Switched off"),
        ([Status.UNSAFE_FILTER_OFF], Level.WARN, "UNSAFE"),
        ([], Level.STALE, "no state has arrived"),
    ],
)
def test_the_worst_is_told(statuses, level, text):
    report = report_on(*map(decision, statuses))
    assert report.level is level
    assert text in report.text


def test_inputs():
    assert input_report("").level is Level.OK
    report = input_report("no distances for 0.4 s")
    assert (report.level, report.text) == (Level.STALE, "No distances for 0.4 s.")
