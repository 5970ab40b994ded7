"""How a node fares, second by second, in words; without ROS messages."""

import time
from collections import Counter
from dataclasses import dataclass, field
from enum import IntEnum
from typing import Dict

import numpy as np

from deformable_manipulation.control.status import Status
from deformable_manipulation.scenario.barriers import BARRIERS

_SLOW = 0.9  # of the wanted rate, below which it is worth a warning
_TOO_SLOW = 0.5


class Level(IntEnum):
    """As in diagnostic_msgs/DiagnosticStatus."""

    OK = 0
    WARN = 1
    ERROR = 2
    STALE = 3


@dataclass(frozen=True)
class Report:
    """What there is to say about one thing: the sentence first, numbers beside it."""

    level: Level
    text: str
    values: Dict[str, str] = field(default_factory=dict)


class CycleMonitor:
    """Rate, latency and time of computation of the states that a node answers.

    Each report tells of the time since the one before.

    Args:
        rate: states per second [Hz] that are to be answered; None: as many as come (lock-step).
        clock: seconds, never decreasing.
    """

    def __init__(self, rate, clock=time.monotonic):
        self._rate = rate
        self._clock = clock
        self._begun = self._last = clock()
        self._latencies, self._durations = [], []
        self._late = 0  # over all reports
        self._failure = ""

    def answered(self, duration, latency):
        """A state was answered.

        Args:
            duration: of the computation [s].
            latency: from the state's stamp to the answer [s]; not looked at in lock-step.
        """
        self._last = self._clock()
        self._durations.append(duration)
        if self._rate is not None:
            self._latencies.append(latency)
            self._late += latency > 1.0 / self._rate

    def failed(self, reason):
        """A state could not be answered, for a reason in a sentence."""
        self._failure = reason

    def report(self):
        """Report on the time since the last one."""
        now = self._clock()
        elapsed, self._begun = now - self._begun, now
        durations, self._durations = self._durations, []
        latencies, self._latencies = self._latencies, []
        failure, self._failure = self._failure, ""
        if failure:
            return Report(Level.ERROR, failure)
        if not durations:
            silence = now - self._last
            return Report(
                Level.STALE,
                f"No state for {silence:.1f} s: paused, or the simulator is gone.",
            )
        rate = len(durations) / max(elapsed, 1e-9)
        values = {"states per second": f"{rate:.1f}"}
        values.update(_spread("computation", durations))
        if latencies:
            values.update(_spread("latency", latencies))
            values["answers that took longer than a cycle, total"] = str(self._late)
        level, text = self._judge(rate, latencies)
        return Report(level, text, values)

    def _judge(self, rate, latencies):
        if self._rate is None:
            return Level.OK, f"Answers every state, {rate:.0f} per second (lock-step)."
        if rate < _SLOW * self._rate:
            level = Level.WARN if rate >= _TOO_SLOW * self._rate else Level.ERROR
            return level, f"Answers {rate:.0f} states per second instead of {self._rate:g}."
        late = sum(latency > 1.0 / self._rate for latency in latencies)
        if 2 * late > len(latencies):
            return Level.ERROR, "Most answers take longer than a cycle: the chain is too slow."
        if late:
            return Level.WARN, f"{late} of {len(latencies)} answers took longer than a cycle."
        return Level.OK, f"Answers {rate:.0f} states per second in time."


class DecisionMonitor:
    """The outcome of a controller's quadratic programs."""

    def __init__(self):
        self._decisions = []

    def decided(self, decision):
        """Take in a :class:`~deformable_manipulation.control.decision.Decision`."""
        self._decisions.append(decision)

    def report(self):
        """Report on the decisions since the last one."""
        decisions, self._decisions = self._decisions, []
        if not decisions:
            return Report(Level.STALE, "Nothing to decide: no state has arrived.")
        level, text = _judge_decisions(decisions)
        return Report(level, text, _decision_values(decisions))


def _judge_decisions(decisions):
    count = Counter(decision.status for decision in decisions)
    total = len(decisions)
    last = decisions[-1]
    if last.status is Status.WAITING:
        return Level.ERROR, last.text
    if count[Status.FAILED]:
        failed = f"{count[Status.FAILED]} of {total} cycles"
        return Level.ERROR, f"Zero velocity in {failed}: the quadratic program had no solution."
    if count[Status.RELAXED]:
        relaxed = f"{count[Status.RELAXED]} of {total} cycles"
        return Level.WARN, f"Not all limits could hold in {relaxed}: {_missed(decisions)}."
    if count[Status.WAITING]:
        return Level.WARN, f"Waited for valid input in {count[Status.WAITING]} of {total} cycles."
    if last.status is Status.UNSAFE_FILTER_OFF:
        return Level.WARN, last.text
    if last.status is Status.CONSTRAINED:
        changed = f"{count[Status.CONSTRAINED]} of {total} cycles"
        return Level.OK, f"Deviates from the nominal velocity in {changed}; all limits hold."
    return Level.OK, last.text


def _missed(decisions):
    missed = {
        name: 1e3 * slack for name in _barriers(decisions) if (slack := _largest(decisions, name))
    }
    return ", ".join(f"{name} missed by {slack:.2f} mm/s at most" for name, slack in missed.items())


def _decision_values(decisions):
    values = {"status": decisions[-1].status.name}
    values["lowest distance [m]"] = _lowest([decision.distance for decision in decisions])
    for name in _barriers(decisions):
        h = [decision.h.get(name, np.nan) for decision in decisions]
        unit = BARRIERS[name].unit if name in BARRIERS else "m"
        values[f"lowest h, {name} [{unit}]"] = _lowest(h)
        values[f"largest slack, {name} [m/s]"] = f"{_largest(decisions, name):.6f}"
    values["error at the end [m]"] = f"{decisions[-1].error_norm:.4f}"
    values["constraints, at most"] = str(max(decision.rows for decision in decisions))
    values.update(_spread("solver", [decision.solve_time for decision in decisions]))
    exact = sum(decision.exact_jacobian for decision in decisions)
    values["cycles with exact gradients"] = f"{exact} of {len(decisions)}"
    return values


def _barriers(decisions):
    """Names of all barriers that were in use."""
    return list(dict.fromkeys(name for decision in decisions for name in decision.slack))


def _largest(decisions, name):
    """The largest slack of a barrier [m/s]."""
    return max(decision.slack.get(name, 0.0) for decision in decisions)


def _lowest(values):
    known = [value for value in values if not np.isnan(value)]
    return f"{min(known):.4f}" if known else "unknown"


def input_report(fault):
    """Report on a node's inputs from the clause that names what is lost; empty: nothing is."""
    if fault:
        return Report(Level.STALE, fault[0].upper() + fault[1:] + ".")
    return Report(Level.OK, "All inputs arrive in time.")


def _spread(name, seconds):
    median, largest = 1e3 * np.median(seconds), 1e3 * max(seconds)
    return {f"{name} [ms], median": f"{median:.3f}", f"{name} [ms], largest": f"{largest:.3f}"}
