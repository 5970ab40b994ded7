"""Runs a scenario many times with random variations and counts what went wrong."""

import argparse
import csv
import dataclasses
import json
import re
import sys
import time
from itertools import product
from pathlib import Path
from typing import Dict, List, Optional, Sequence, Tuple

from deformable_manipulation.campaign import workers
from deformable_manipulation.campaign.exit_status import UNACCEPTABLE
from deformable_manipulation.campaign.leader_paths import DIVES, PLACES
from deformable_manipulation.campaign.outcome import RunOutcome
from deformable_manipulation.campaign.report import (
    describe,
    describe_classes,
    is_acceptable,
    summarise,
    worst,
)
from deformable_manipulation.campaign.runs import Campaign, Classes
from deformable_manipulation.campaign.variation import NoVariation, Ranges, vary
from deformable_manipulation.commands.arguments import (
    add_scenario_arguments,
    add_world_argument,
    command_parser,
    folder_name,
    scenario_overrides,
)
from deformable_manipulation.commands.copied_name import name_warning
from deformable_manipulation.commands.output_folder import writable_folder
from deformable_manipulation.commands.progress import ProgressDisplay
from deformable_manipulation.commands.without_ros import warn_of_standing_obstacles
from deformable_manipulation.recording.provenance import machine, package_version
from deformable_manipulation.recording.run_files import atomic_file
from deformable_manipulation.scenario import ScenarioError, load_scenario, scenario_to_yaml
from deformable_manipulation.scenario.horizon import ANNOUNCED, FADING, KNOWN
from deformable_manipulation.scenario.spec import Scenario
from deformable_manipulation.system.interruption import (
    exit_status,
    interruptible,
    interrupts_ignored,
)

DESCRIPTION = """Run a scenario many times without ROS and count violated limits, deadlocks,
relaxed programs and oscillation. Each run has a random smooth path of the leader, random obstacles
of the same kind, other starts and another material. The same seed gives the same runs on every
machine. Writes campaign.json, runs.csv, campaign.png and worst.yaml, the scenario of the worst run.
"""
EPILOG = """examples:
  run_campaign rope_one_assistant --runs 200 --seed 1
  run_campaign rope_two_assistants --runs 50 --speed 0.15 --output output/fast
  run_campaign rope_one_assistant --runs 100 --speed 0.2,0.3 --path places,dives \\
    --leader fading,announced --foreknowledge
  run_campaign rope_one_assistant --runs 2000 --cluster tcp://10.0.0.1:8786
  run_scenario output/fast/worst.yaml      # repeats the worst run

The exit status is 0 if no limit is violated by more than the tolerance, no run broke down or
deadlocked, no program failed, and no assistant waited for most of a run; 3 otherwise.
"""
_FASTEST = 2.0  # m/s, of a leader
_LONGEST = 1e5  # s


def main(argv: Optional[Sequence[str]] = None) -> int:
    """Run the command; returns its exit code."""
    arguments = _parse(argv)
    try:
        scenario = load_scenario(arguments.scenario, scenario_overrides(arguments))
        classes = _classes(scenario, arguments)
        for each in classes.campaigns:
            vary(each.scenario, each.ranges, each.seed, 0)  # what cannot be varied fails at once
        folder = _prepare(arguments, scenario)
    except (ScenarioError, NoVariation, OSError) as error:
        print(f"run_campaign: {error}", file=sys.stderr)
        return 1
    warn_of_standing_obstacles("run_campaign", scenario)
    misnamed = name_warning(scenario, arguments.scenario)
    if misnamed:
        print(f"run_campaign: WARNING: {misnamed}", file=sys.stderr)
    with interruptible():
        return _run(classes, arguments, folder)


def _parse(argv: Optional[Sequence[str]]) -> argparse.Namespace:
    parser = command_parser("run_campaign", DESCRIPTION, EPILOG)
    add_scenario_arguments(parser)
    add_world_argument(parser)
    defaults = Ranges()
    parser.add_argument(
        "--runs",
        type=_positive(int),
        default=100,
        metavar="N",
        help="number of runs, of each class (%(default)s)",
    )
    parser.add_argument(
        "--seed", type=_natural, default=0, metavar="S", help="0 or more (%(default)s)"
    )
    parser.add_argument(
        "--speed",
        type=_several(_speed),
        default=(defaults.speed,),
        metavar="M/S[,M/S...]",
        help=f"limit of each component of the leader's velocity ({defaults.speed}); several, "
        "separated by commas: a class of runs for each",
    )
    parser.add_argument(
        "--path",
        type=_several(_one_of(PLACES, DIVES)),
        default=(defaults.path,),
        metavar="KIND[,KIND]",
        help=f"{PLACES}: the leader goes from place to place near the obstacles (default); "
        f"{DIVES}: it plunges straight down to them; both: a class for each",
    )
    parser.add_argument(
        "--leader",
        type=_several(_one_of(FADING, ANNOUNCED, KNOWN)),
        metavar="EXPECTED[,EXPECTED...]",
        help="controller.horizon.leader: a class for each of these, with the same runs",
    )
    parser.add_argument(
        "--foreknowledge",
        action="store_true",
        help="try each run that misses a limit again with controllers that know the leader's path "
        "many seconds ahead, to see whether it can be answered at all; takes several times as long "
        "for these runs",
    )
    parser.add_argument(
        "--duration",
        type=_duration,
        default=defaults.duration,
        metavar="S",
        help="duration of each run (%(default)s)",
    )
    parser.add_argument(
        "--clearance",
        type=_positive(float),
        default=defaults.clearance,
        metavar="M",
        help="distance of the leader's grip from the obstacles (%(default)s)",
    )
    parser.add_argument(
        "--material",
        type=_factor,
        default=defaults.material,
        metavar="FACTOR",
        help="change stiffness and weight by up to this factor (%(default)s)",
    )
    parser.add_argument(
        "--own-terrain",
        dest="terrain",
        action="store_false",
        help="keep the obstacles of the scenario",
    )
    parser.add_argument(
        "--imperfect",
        action="store_true",
        help="make the controllers' knowledge imperfect, randomly: pose noise of up to 2 mm, "
        "pose delay of up to 50 ms, material wrong by up to a factor of 2, up to 20 %% dropped "
        "cycles",
    )
    parser.add_argument(
        "--tolerance",
        type=_not_negative,
        default=0.001,
        metavar="M",
        help="smaller violations do not count (%(default)s)",
    )
    parser.add_argument(
        "--workers", type=_positive(int), metavar="N", help="processes (default: one per core)"
    )
    parser.add_argument(
        "--cluster",
        type=_address,
        metavar="tcp://HOST:PORT",
        help="a Dask scheduler whose workers do the runs",
    )
    parser.add_argument(
        "--no-safety", dest="safety", action="store_false", help="switch the safety filter off"
    )
    parser.add_argument(
        "--output",
        metavar="DIR",
        type=folder_name,
        help="default: output/campaign_<scenario>_<time>",
    )
    return parser.parse_args(argv)


def _several(kind):
    """Values separated by commas, each once."""

    def convert(text):
        values = tuple(map(kind, text.split(",")))
        if len(set(values)) < len(values):
            raise argparse.ArgumentTypeError(f"'{text}': each value must be there once")
        return values

    convert.__name__ = "list"
    return convert


def _one_of(*allowed):
    def convert(text):
        if text not in allowed:
            raise argparse.ArgumentTypeError(f"'{text}': must be {' or '.join(allowed)}")
        return text

    return convert


def _positive(kind):
    def convert(text):
        value = kind(text)
        if not 0 < value < float("inf"):
            raise argparse.ArgumentTypeError(f"'{text}': must be more than 0")
        return value

    convert.__name__ = "number"
    return convert


def _not_negative(text):
    value = float(text)
    if not 0 <= value < float("inf"):
        raise argparse.ArgumentTypeError(f"'{text}': must be a finite number, 0 or more")
    return value


def _duration(text):
    value = _positive(float)(text)
    if value > _LONGEST:
        raise argparse.ArgumentTypeError(f"'{text}': must be at most {_LONGEST:g} s")
    return value


def _speed(text):
    value = _positive(float)(text)
    if value > _FASTEST:
        raise argparse.ArgumentTypeError(
            f"'{text}': must be at most {_FASTEST:g} m/s; assistants move at "
            f"controller.max_velocity, and cannot follow a leader that is much faster"
        )
    return value


def _natural(text):
    value = int(text)
    if value < 0:
        raise argparse.ArgumentTypeError(f"'{text}': must be 0 or more")
    return value


def _address(text):
    if not re.fullmatch(r"(\w+://)?[^\s:/]+:\d+", text):
        raise argparse.ArgumentTypeError(f"'{text}': must be of the form tcp://HOST:PORT")
    return text


def _factor(text):
    value = float(text)
    if not 1.0 <= value <= 100.0:
        raise argparse.ArgumentTypeError(f"'{text}': must be 1 (no change) to 100")
    return value


def _classes(scenario: Scenario, arguments: argparse.Namespace) -> Classes:
    """A campaign for each kind of path, speed and expectation of the leader."""
    common = {
        field.name: getattr(arguments, field.name)
        for field in dataclasses.fields(Ranges)
        if field.name not in ("path", "speed")
    }
    expected = arguments.leader or (scenario.controller.horizon.leader,)
    return Classes(
        tuple(
            Campaign(
                _expecting(scenario, leader),
                Ranges(path=path, speed=speed, **common),
                arguments.seed,
                arguments.safety,
                arguments.tolerance,
                arguments.foreknowledge,
            )
            for path, speed, leader in product(arguments.path, arguments.speed, expected)
        ),
        arguments.runs,
    )


def _expecting(scenario: Scenario, leader: str) -> Scenario:
    """The scenario with controllers that expect the leader to do so."""
    horizon = dataclasses.replace(scenario.controller.horizon, leader=leader)
    controller = dataclasses.replace(scenario.controller, horizon=horizon)
    return dataclasses.replace(scenario, controller=controller)


def _prepare(arguments: argparse.Namespace, scenario: Scenario) -> Path:
    default = Path("output") / f"campaign_{scenario.name}_{time.strftime('%Y%m%d_%H%M%S')}"
    folder = arguments.output or default
    if (folder / "campaign.json").exists():
        raise FileExistsError(f"{folder} already holds a campaign; choose another --output")
    try:
        writable_folder(folder)  # now, not after hours of runs
    except OSError as error:
        raise OSError(
            f"cannot write into {folder}: {error.strerror}; choose a writable folder with --output"
        ) from error
    return folder


def _run(classes: Classes, arguments: argparse.Namespace, folder: Path) -> int:
    """Do the runs; what has been done is written, whatever ends them."""
    outcomes: List[RunOutcome] = []
    progress = ProgressDisplay(sys.stderr)
    started = time.perf_counter()
    code = 0
    try:
        for outcome in _outcomes(classes, arguments):
            outcomes.append(outcome)
            progress(len(outcomes) / len(classes))
    except KeyboardInterrupt as interrupt:
        code = exit_status(interrupt)
    except (workers.WorkersLost, OSError, ImportError) as error:
        print(f"\nrun_campaign: {error}", file=sys.stderr)
        code = 1
    finally:
        progress.close()
    if not outcomes:
        print("run_campaign: no run had finished, so nothing is kept", file=sys.stderr)
        return code or 1
    outcomes.sort(key=lambda outcome: outcome.index)
    summary = summarise(outcomes, arguments.tolerance)
    with interrupts_ignored():
        _write(classes, arguments, outcomes, summary, time.perf_counter() - started, folder)
    if len(classes.campaigns) > 1:
        found = [each for _, each in _by_class(classes, outcomes)]
        print(describe_classes(found, arguments.tolerance))
    else:
        print(describe(summary))
    print(f"written to {folder}; the worst run: run_scenario {folder / 'worst.yaml'}")
    if len(outcomes) < len(classes):
        print(
            f"run_campaign: only {len(outcomes)} of {len(classes)} runs were done. They are kept "
            f"in {folder / 'runs.csv'} and counted in {folder / 'campaign.json'}. For all "
            "of them, start again with another --output: the same seed gives the same runs",
            file=sys.stderr,
        )
    return code or (0 if is_acceptable(summary) else UNACCEPTABLE)


def _outcomes(classes: Classes, arguments: argparse.Namespace):
    indices = range(len(classes))
    if arguments.cluster:
        return workers.run_on_cluster(classes, indices, arguments.cluster)
    return workers.run_here(classes, indices, arguments.workers or workers.cores())


def _by_class(
    classes: Classes, outcomes: List[RunOutcome]
) -> List[Tuple[Campaign, List[RunOutcome]]]:
    """The outcomes of each class of which there are any, in order."""
    found: Dict[int, List[RunOutcome]] = {}
    for outcome in outcomes:
        found.setdefault(outcome.index // classes.runs, []).append(outcome)
    return [(classes.campaigns[number], each) for number, each in sorted(found.items())]


def _write(classes, arguments, outcomes, summary, wall_time, folder: Path) -> None:
    from deformable_manipulation.campaign.plots import plot_campaign
    from deformable_manipulation.plots.style import save_figure

    first = classes.campaigns[0]
    content = {
        "scenario": first.scenario.name,
        "seed": first.seed,
        "safety": first.safety,
        "classes": [
            {
                "ranges": dataclasses.asdict(campaign.ranges),
                "leader": campaign.scenario.controller.horizon.leader,
                "summary": summarise(found, arguments.tolerance),
            }
            for campaign, found in _by_class(classes, outcomes)
        ],
        "summary": summary,
        "wall_time": wall_time,
        "version": package_version(),
        "machine": machine(),
    }
    with atomic_file(folder / "campaign.json") as file:
        json.dump(content, file, indent=2)
        file.write("\n")
    with atomic_file(folder / "runs.csv") as file:
        rows = [outcome.to_mapping() for outcome in outcomes]
        table = csv.DictWriter(file, dict.fromkeys(name for row in rows for name in row))
        table.writeheader()
        table.writerows(rows)
    campaign, number = classes.locate(worst(outcomes).index)
    try:
        varied = vary(campaign.scenario, campaign.ranges, campaign.seed, number)
    except NoVariation as error:
        print(f"run_campaign: {error}", file=sys.stderr)
    else:
        with atomic_file(folder / "worst.yaml") as file:
            file.write(scenario_to_yaml(varied))
    offset = first.scenario.controller.collision.offset
    save_figure(plot_campaign(outcomes, offset, first.scenario.name), folder / "campaign.png")
