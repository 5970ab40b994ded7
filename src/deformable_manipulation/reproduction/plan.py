"""Which runs, figures and campaigns make the report, and the commands that make them."""

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Dict, List, Sequence, Tuple

from deformable_manipulation.campaign.exit_status import UNACCEPTABLE
from deformable_manipulation.reproduction.jobs import Job
from deformable_manipulation.reproduction.paper import PUBLISHED
from deformable_manipulation.scenario import load_scenario

FULL, PAPER, UNFILTERED = "full", "paper", "filter_off"
# What makes each variant of a run, and what the report calls it.
VARIANTS: Dict[str, Tuple[str, Tuple[str, ...]]] = {
    FULL: ("full formulation", ()),
    PAPER: ("paper's formulation", ("--set", "controller.formulation=paper")),
    UNFILTERED: ("safety filter off", ("--no-safety",)),
}
_CAMPAIGN_SEED = 1
_CAMPAIGN_DURATION = 60  # s, of each run


@dataclass(frozen=True)
class Plan:
    """The report's content and where its parts are written."""

    folder: Path
    scenarios: Sequence[str]
    overrides: Sequence[Tuple[str, str]] = ()  # of every scenario's values
    campaign_runs: int = 0  # of each campaign; 0: none
    pictures: bool = True  # RViz's

    def run_folder(self, scenario: str, variant: str) -> Path:
        """Where a run is recorded."""
        return self.folder / "runs" / f"{scenario}_{variant}"

    def figure_folder(self, scenario: str) -> Path:
        """Where a scenario's figures and pictures are."""
        return self.folder / "figures" / scenario

    def campaign_folder(self, scenario: str, variant: str) -> Path:
        """Where a campaign is recorded."""
        return self.folder / "campaigns" / f"{scenario}_{variant}"

    def campaigns(self) -> List[Tuple[str, str]]:
        """Scenario and variant of each campaign: of ropes, whose runs take a second."""
        ropes = [name for name in self.scenarios if name.startswith("rope") and self.campaign_runs]
        return [(name, variant) for name in ropes for variant in (FULL, PAPER)]

    def runs(self) -> List[Job]:
        """Every scenario in every variant; the longest, the fabrics', first."""
        order = sorted(self.scenarios, key=lambda name: not name.startswith("fabric"))
        return [
            self._job(
                f"run {name}, {title}",
                "run_scenario",
                name,
                *options,
                *self._sets(),
                "--output",
                str(self.run_folder(name, variant)),
            )
            for name in order
            for variant, (title, options) in VARIANTS.items()
        ]

    def figures(self) -> List[Job]:
        """The data plots and the overview of every scenario's full run."""
        return [
            self._job(
                f"plot {name}",
                "plot_run",
                str(self.run_folder(name, FULL)),
                "--output",
                str(self.figure_folder(name)),
                "--format",
                "png,pdf",
            )
            for name in self.scenarios
        ]

    def snapshots(self) -> List[Job]:
        """RViz's picture of every scenario's full run."""
        return [
            self._job(
                f"picture of {name}",
                "rviz_snapshot",
                str(self.run_folder(name, FULL)),
                *_snapshot_options(name, self.overrides),
                "--output",
                str(self.figure_folder(name)),
            )
            for name in (self.scenarios if self.pictures else ())
        ]

    def campaign_jobs(self) -> List[Job]:
        """The campaigns; each takes all cores."""
        return [
            self._job(
                f"campaign {name}, {VARIANTS[variant][0]}",
                "run_campaign",
                name,
                *VARIANTS[variant][1],
                *self._sets(),
                *("--runs", str(self.campaign_runs), "--seed", str(_CAMPAIGN_SEED)),
                *("--duration", str(_CAMPAIGN_DURATION)),
                "--output",
                str(self.campaign_folder(name, variant)),
                accepted=(0, UNACCEPTABLE),
            )
            for name, variant in self.campaigns()
        ]

    def _sets(self) -> List[str]:
        return [text for key, value in self.overrides for text in ("--set", f"{key}={value}")]

    def _job(self, title: str, command: str, *arguments: str, accepted=(0,)) -> Job:
        program = (sys.executable, "-m", "deformable_manipulation.commands", command)
        log = self.folder / "logs" / (title.replace(" ", "_").replace(",", "") + ".log")
        return Job(title, (*program, *arguments), log, accepted)


def _snapshot_options(scenario: str, overrides: Sequence[Tuple[str, str]]) -> Tuple[str, ...]:
    """Several times in one picture, the paper's where it has some."""
    times = PUBLISHED[scenario].snapshots if scenario in PUBLISHED else ()
    if not times or times[-1] > load_scenario(scenario, overrides).simulation.duration:
        return ("--layout", "auto")
    return ("--layout", "auto", "--times", ",".join(f"{time:g}" for time in times))
