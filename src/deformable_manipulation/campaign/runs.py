"""One run of a campaign, as any worker does it."""

import dataclasses
import math
from dataclasses import dataclass
from typing import Protocol, Tuple

from deformable_manipulation.campaign.foreknowledge import least_overstretch, with_foresight
from deformable_manipulation.campaign.outcome import (
    IMPOSSIBLE,
    KEPT,
    POSSIBLE,
    UNKNOWN,
    RunOutcome,
    assess,
)
from deformable_manipulation.campaign.variation import NoVariation, Ranges, vary
from deformable_manipulation.recording.timeseries import TimeSeries
from deformable_manipulation.running.closed_loop import ClosedLoop
from deformable_manipulation.scenario.spec import Scenario


class Runs(Protocol):
    """What workers need to do: runs by their numbers."""

    def run(self, index: int) -> RunOutcome:
        """Do one run."""


@dataclass(frozen=True)
class Campaign:
    """Everything that a worker needs to do any run of a campaign."""

    scenario: Scenario
    ranges: Ranges
    seed: int
    safety: bool = True
    tolerance: float = 0.001  # m, up to which a violation does not count
    foreknowledge: bool = False  # True: runs that miss a limit are tried with the path known

    def run(self, index: int) -> RunOutcome:
        """Do one run. If the simulation breaks down, the outcome says so; nothing is raised."""
        try:
            scenario = vary(self.scenario, self.ranges, self.seed, index)
        except NoVariation as error:
            return self._named(_not_started(index, str(error)))
        return self._named(self._judged(scenario, self._run(scenario, index)))

    def _named(self, outcome: RunOutcome) -> RunOutcome:
        leader = self.scenario.controller.horizon.leader
        return dataclasses.replace(
            outcome, path=self.ranges.path, speed=self.ranges.speed, leader=leader
        )

    def _run(self, scenario: Scenario, index: int) -> RunOutcome:
        series = SeriesRecorder(scenario)
        problem = None
        try:
            ClosedLoop(scenario, self.safety).run(series)
        except (RuntimeError, ValueError) as error:
            problem = str(error)
        return assess(scenario, series.series, index, problem)

    def _judged(self, scenario: Scenario, outcome: RunOutcome) -> RunOutcome:
        """The outcome with what somebody could have done who knows the leader's path."""
        if not outcome.misses(self.tolerance):
            return dataclasses.replace(outcome, answer=KEPT)
        least = least_overstretch(scenario) or 0.0
        answer = IMPOSSIBLE if least > self.tolerance else self._answer(scenario, outcome.index)
        return dataclasses.replace(outcome, answer=answer, least_overstretch=least)

    def _answer(self, scenario: Scenario, index: int) -> str:
        tried = with_foresight(scenario) if self.foreknowledge else ()
        possible = any(not self._run(each, index).misses(self.tolerance) for each in tried)
        return POSSIBLE if possible else UNKNOWN


@dataclass(frozen=True)
class Classes:
    """Several campaigns of as many runs each, which are done as one.

    Its runs are numbered through: those of the first campaign, then those of the second one ...
    """

    campaigns: Tuple[Campaign, ...]
    runs: int  # of each campaign

    def __len__(self) -> int:
        return self.runs * len(self.campaigns)

    def run(self, index: int) -> RunOutcome:
        """Do one of all runs."""
        campaign, number = self.locate(index)
        return dataclasses.replace(campaign.run(number), index=index)

    def locate(self, index: int) -> Tuple[Campaign, int]:
        """The campaign that a run belongs to, and its number there."""
        campaign, number = divmod(index, self.runs)
        return self.campaigns[campaign], number


class SeriesRecorder:
    """Keeps the table of a run, and no files."""

    def __init__(self, scenario: Scenario):
        self.series = TimeSeries.of(scenario)
        self.record = self.series.append


def _not_started(index: int, problem: str) -> RunOutcome:
    return RunOutcome(
        index=index,
        completed=False,
        problem=problem,
        min_distance=math.inf,
        violations={},
        deadlock=False,
        stuck=False,
        relaxed=0,
        failed=0,
        oscillation=0.0,
        tracking_error=0.0,
        final_error=0.0,
        constrained=0.0,
        shape_error=0.0,
    )
