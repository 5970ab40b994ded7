"""Reproduces the paper's experiments and reports them on one page."""

import argparse
import sys
import time
from pathlib import Path
from typing import List, Optional, Sequence

from deformable_manipulation.commands.arguments import command_parser, override
from deformable_manipulation.commands.failure import fail
from deformable_manipulation.reproduction.display import JobDisplay
from deformable_manipulation.reproduction.jobs import JobFailed, run_jobs
from deformable_manipulation.reproduction.plan import Plan
from deformable_manipulation.scenario import ScenarioError, load_scenario, scenario_names
from deformable_manipulation.system.interruption import exit_status, interruptible
from deformable_manipulation.system.program import ProgramError

NAME = "reproduce"
REPORT = "report.html"
DESCRIPTION = """Run the scenarios with the full formulation, with the paper's formulation and
without the safety filter. Draw data plots, overviews and RViz pictures, run small campaigns, and
write one HTML page with all results and the paper's execution times next to those of this machine.
This takes minutes and needs no display."""
EXAMPLES = """examples:
  reproduce
  reproduce rope_one_assistant rope_two_assistants --output output/ropes
  reproduce rope_one_assistant --campaign-runs 0          a minute or two
  reproduce --campaign-runs 200
  reproduce rope_one_assistant --no-pictures --set simulation.duration=40
"""


def main(argv: Optional[Sequence[str]] = None) -> int:
    """Run the command; returns its exit status."""
    arguments = _parse(argv)
    try:
        scenarios = _chosen(arguments.scenarios)
        for name in scenarios:
            load_scenario(name, arguments.set)
        plan = _prepare(scenarios, arguments)
    except ScenarioError as error:
        print(error, file=sys.stderr)
        return 1
    except ValueError as error:
        return fail(NAME, str(error))
    except OSError as error:
        return fail(NAME, f"cannot write the report: {error}")
    with interruptible():
        try:
            _make(plan)
        except (JobFailed, ProgramError) as error:
            return fail(NAME, f"{error}\nWhat the commands printed is in {plan.folder / 'logs'}.")
        except OSError as error:
            return fail(NAME, f"cannot write the report: {error}")
        except KeyboardInterrupt as interrupt:
            return exit_status(interrupt)
    return 0


def _parse(argv: Optional[Sequence[str]]) -> argparse.Namespace:
    parser = command_parser(NAME, DESCRIPTION, EXAMPLES)
    parser.add_argument(
        "scenarios",
        nargs="*",
        metavar="SCENARIO",
        help="names of this package's scenarios (default: all)",
    )
    parser.add_argument(
        "--set",
        metavar="KEY.PATH=VALUE",
        type=override,
        action="append",
        default=[],
        help="replace a value of every scenario; can be given several times",
    )
    parser.add_argument(
        "--campaign-runs",
        type=_count,
        default=40,
        metavar="N",
        help="number of random runs for each rope and formulation; 0: none (%(default)s)",
    )
    parser.add_argument(
        "--no-pictures",
        dest="pictures",
        action="store_false",
        help="leave out the pictures from RViz, which need ROS",
    )
    parser.add_argument("--output", metavar="DIR", help="default: output/reproduce_<time>")
    return parser.parse_args(argv)


def _count(text: str) -> int:
    if not text.isdecimal():
        raise argparse.ArgumentTypeError(f"'{text}': must be a whole number, 0 or more")
    return int(text)


def _chosen(names: Sequence[str]) -> List[str]:
    known = scenario_names()
    unknown = [name for name in names if name not in known]
    if unknown:
        raise ValueError(
            "there is no scenario '{}'; allowed: {}".format("', '".join(unknown), ", ".join(known))
        )
    return [name for name in known if name in names or not names]


def _prepare(scenarios: List[str], arguments: argparse.Namespace) -> Plan:
    default = Path("output") / "{}_{}".format(NAME, time.strftime("%Y%m%d_%H%M%S"))
    folder = Path(arguments.output) if arguments.output else default
    if folder.is_dir() and any(folder.iterdir()):
        raise FileExistsError(f"{folder} is not empty; choose another --output")
    (folder / "logs").mkdir(parents=True, exist_ok=True)
    return Plan(folder, scenarios, arguments.set, arguments.campaign_runs, arguments.pictures)


def _make(plan: Plan) -> None:
    # Imported late: load what a mistake in the arguments does not need.
    from deformable_manipulation.benchmarks.machine import describe_machine
    from deformable_manipulation.campaign.workers import cores
    from deformable_manipulation.reproduction.page import write_page

    machine = describe_machine()
    started = time.monotonic()
    # Plots and runs go side by side; RViz and the campaigns take all cores by themselves.
    phases = (
        (plan.runs(), cores()),
        (plan.figures(), cores()),
        (plan.snapshots(), 1),
        (plan.campaign_jobs(), 1),
    )
    display = JobDisplay(NAME, sum(len(jobs) for jobs, _ in phases), sys.stderr)
    for jobs, parallel in phases:
        run_jobs(jobs, parallel, display)
    write_page(plan, plan.folder / REPORT, machine, time.monotonic() - started)
    print(plan.folder / REPORT)
