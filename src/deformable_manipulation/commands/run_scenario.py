"""Runs a scenario in one process, without ROS, and records it."""

import argparse
import sys
import time
from pathlib import Path
from typing import Optional, Sequence

from deformable_manipulation.commands.arguments import (
    add_scenario_arguments,
    add_world_argument,
    folder_name,
    scenario_overrides,
)
from deformable_manipulation.commands.copied_name import name_warning
from deformable_manipulation.commands.progress import ProgressDisplay
from deformable_manipulation.commands.without_ros import warn_of_standing_obstacles
from deformable_manipulation.recording import RecordingError, RunRecorder
from deformable_manipulation.recording.summary import describe
from deformable_manipulation.scenario import ScenarioError, load_scenario
from deformable_manipulation.scenario.spec import Scenario
from deformable_manipulation.system.interruption import (
    exit_status,
    interruptible,
    interrupts_ignored,
)

EXAMPLES = """examples:
  run_scenario rope_one_assistant
  run_scenario my_scenario.yaml --output output/trial --force
  run_scenario rope_one_assistant --no-safety
  run_scenario rope_one_assistant --set simulation.duration=20 \\
      --set controller.collision.offset=0.1

exit status: 0 the run was done to its end, whatever became of its limits (the summary tells); 1 it
could not be done; 2 wrong usage. Use run_campaign where missed limits shall make a script fail.
"""


def main(argv: Optional[Sequence[str]] = None) -> int:
    """Run the command; returns its exit code."""
    arguments = _parse(argv)
    try:
        scenario = load_scenario(arguments.scenario, scenario_overrides(arguments))
        # Before the folder is made: a scenario that cannot be simulated leaves nothing behind.
        loop = _make_loop(scenario, arguments.safety)
        folder = arguments.output or _default_folder(scenario)
        recorder = RunRecorder(scenario, folder, arguments.safety, arguments.force, loop.rest)
    except (ScenarioError, RecordingError) as error:
        print(error, file=sys.stderr)
        return 1
    except KeyboardInterrupt as interrupt:
        return exit_status(interrupt)  # nothing has been recorded yet
    except (ValueError, RuntimeError) as error:
        # Of the simulation: a parameter out of its range, no settled shape.
        print(f"run_scenario: the scenario cannot be simulated: {error}", file=sys.stderr)
        return 1
    warn_of_standing_obstacles("run_scenario", scenario)
    misnamed = name_warning(scenario, arguments.scenario)
    if misnamed:
        print(f"run_scenario: WARNING: {misnamed}", file=sys.stderr)
    _warn_of_start(loop, scenario.controller.collision.offset)
    _warn_of_poses(scenario)
    with interruptible():
        return _run(loop, recorder)


def _parse(argv: Optional[Sequence[str]]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="run_scenario",
        description="Run a scenario without ROS, as fast as the machine allows, and record it.",
        epilog=EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add_scenario_arguments(parser)
    add_world_argument(parser)
    parser.add_argument(
        "--output",
        metavar="DIR",
        type=folder_name,
        help="folder of the run (default: output/<scenario>_<time>)",
    )
    parser.add_argument(
        "--no-safety",
        dest="safety",
        action="store_false",
        help="switch the safety filter off: follow the leader regardless of obstacles",
    )
    parser.add_argument(
        "--force", action="store_true", help="overwrite the run in the output folder"
    )
    return parser.parse_args(argv)


def _default_folder(scenario: Scenario) -> Path:
    return Path("output") / "{}_{}".format(scenario.name, time.strftime("%Y%m%d_%H%M%S"))


def _make_loop(scenario: Scenario, safety: bool):
    # Imported late: loads controllers and distances, which help and error messages do not need.
    from deformable_manipulation.running.closed_loop import ClosedLoop

    return ClosedLoop(scenario, safety=safety)


def _warn_of_start(loop, offset: float) -> None:
    """Warn of a start that is allowed but rarely intended: not at rest, too soft, or near."""
    for warning in loop.warnings:
        print(f"run_scenario: WARNING: {warning}", file=sys.stderr)
    distance = loop.distance()
    if distance < offset:
        print(
            f"run_scenario: WARNING: the object starts {1e3 * distance:.1f} mm from the obstacles, "
            f"closer than controller.collision.offset, {1e3 * offset:.1f} mm (negative: inside)",
            file=sys.stderr,
        )


def _warn_of_poses(scenario: Scenario) -> None:
    """Without ROS nobody publishes poses."""
    names = [agent.name for agent in scenario.agents if agent.driven_by == "pose"]
    if names:
        print(
            f"run_scenario: WARNING: without ROS {', '.join(names)} moves as commanded, as with "
            f"driven_by: command; to simulate late and noisy poses, use the section `knowledge` "
            f"(docs/parameters.md)",
            file=sys.stderr,
        )


def _run(loop, recorder: RunRecorder) -> int:
    """Run the loop to its end or interruption; the recorder writes what there is either way."""
    progress = ProgressDisplay(sys.stderr)
    code = 1
    completed = False
    start = time.perf_counter()
    try:
        loop.run(recorder, progress)
        completed = True
        code = 0
    except KeyboardInterrupt as interrupt:
        code = exit_status(interrupt)
    except RuntimeError as error:
        # Of the simulation: a state that is no longer finite.
        print(f"\nrun_scenario: the run stopped: {error}", file=sys.stderr)
    finally:
        wall_time = time.perf_counter() - start
        progress.close()
        written = _finish(recorder, wall_time, completed)
    return code if written else 1


def _finish(recorder: RunRecorder, wall_time: float, completed: bool) -> bool:
    """Write the run and tell its main numbers; false where files could not be written."""
    with interrupts_ignored():
        try:
            summary = recorder.finish(wall_time, completed)
        except RecordingError as error:
            print(f"run_scenario: {error}", file=sys.stderr)
            return False
    print(describe(summary))
    print(f"written to {recorder.directory}")
    return True
