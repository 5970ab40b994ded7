"""One run of a campaign, as any worker does it."""

import math
from dataclasses import dataclass

from deformable_manipulation.campaign.outcome import RunOutcome, assess
from deformable_manipulation.campaign.variation import NoVariation, Ranges, vary
from deformable_manipulation.recording.timeseries import TimeSeries
from deformable_manipulation.running.closed_loop import ClosedLoop
from deformable_manipulation.scenario.spec import Scenario


@dataclass(frozen=True)
class Campaign:
    """Everything that a worker needs to do any run of a campaign."""

    scenario: Scenario
    ranges: Ranges
    seed: int
    safety: bool = True

    def run(self, index: int) -> RunOutcome:
        """Do one run. If the simulation breaks down, the outcome says so; nothing is raised."""
        try:
            scenario = vary(self.scenario, self.ranges, self.seed, index)
        except NoVariation as error:
            return _not_started(index, str(error))
        series = SeriesRecorder(scenario)
        problem = None
        try:
            ClosedLoop(scenario, self.safety).run(series)
        except (RuntimeError, ValueError) as error:
            problem = str(error)
        return assess(scenario, series.series, index, problem)


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
        relaxed=0,
        failed=0,
        oscillation=0.0,
        tracking_error=0.0,
        final_error=0.0,
        constrained=0.0,
        shape_error=0.0,
    )
