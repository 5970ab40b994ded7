"""Saves pictures of a scenario as RViz shows it, without a screen."""

import argparse
import sys
import tempfile
from pathlib import Path
from typing import Optional, Sequence, Tuple

from deformable_manipulation.authoring.rviz_choice import rviz_configuration
from deformable_manipulation.commands.arguments import add_scenario_arguments, folder_name, times_of
from deformable_manipulation.commands.failure import fail
from deformable_manipulation.commands.progress import ProgressDisplay
from deformable_manipulation.interruption import exit_status, interruptible
from deformable_manipulation.scenario import ScenarioError, load_scenario
from deformable_manipulation.scenario.files import find_scenario
from deformable_manipulation.scenario.spec import Scenario

NAME = "rviz_snapshot"
LEAST_SIZE, LARGEST_SIZE = 64, 8192  # pixels
DESCRIPTION = """Save pictures of a scenario as RViz shows it. Runs the scenario in lock-step on a
ROS master of its own, stops it at each time, and takes a picture of RViz on a virtual display.
Nothing that runs already is disturbed, and no screen is needed."""
EXAMPLES = """examples:
  rviz_snapshot rope_one_assistant --times 30,60,130
  rviz_snapshot my_scenario.yaml --output figures --size 1920x1080 --view YZ
  rviz_snapshot rope_one_assistant --set controller.collision.offset=0.1

The pictures are named SCENARIO_tTIME.png; their paths are printed.
exit status: 0 every picture is saved, 1 one is not (the reason is on stderr), 2 wrong usage
"""


def main(argv: Optional[Sequence[str]] = None) -> int:
    """Run the command; returns its exit status."""
    arguments = _parse(argv)
    try:
        scenario = load_scenario(arguments.scenario, arguments.set)
    except ScenarioError as error:
        print(error, file=sys.stderr)
        return 1
    times = sorted(set(arguments.times or [0.5 * scenario.simulation.duration]))
    if times[-1] > scenario.simulation.duration:
        return fail(
            NAME,
            f"--times: {times[-1]:g} s is after the end of the scenario; "
            f"allowed: 0 to {scenario.simulation.duration:g} s",
        )
    # Imported late: ROS takes longer to load than a mistake in the arguments to be told.
    from deformable_manipulation.ros.program import ProgramError

    with interruptible():
        try:
            _take_all(scenario, times, arguments)
        except ProgramError as error:
            return fail(NAME, str(error))
        except OSError as error:
            return fail(NAME, f"cannot write the pictures: {error}")
        except KeyboardInterrupt as interrupt:
            return exit_status(interrupt)
    return 0


def _parse(argv: Optional[Sequence[str]]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog=NAME,
        description=DESCRIPTION,
        epilog=EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add_scenario_arguments(parser)
    parser.add_argument(
        "--times",
        type=times_of,
        metavar="SECONDS",
        help="when to take pictures, separated by commas (default: half of the duration)",
    )
    parser.add_argument(
        "--output",
        metavar="DIR",
        type=folder_name,
        default=Path("."),
        help="folder (default: this one)",
    )
    parser.add_argument(
        "--size",
        type=size_of,
        default=(1280, 800),
        metavar="WIDTHxHEIGHT",
        help="of the pictures, in pixels (default: 1280x800)",
    )
    parser.add_argument("--view", metavar="NAME", help="a saved view of the RViz configuration")
    parser.add_argument(
        "--config",
        metavar="FILE",
        type=Path,
        help="RViz configuration (default: that of the scenario, "
        "or one of this package for objects of its type where it has none)",
    )
    parser.add_argument(
        "--timeout",
        type=float,
        default=60.0,
        metavar="SECONDS",
        help="how long to wait for each picture (default: 60)",
    )
    return parser.parse_args(argv)


def size_of(text: str) -> Tuple[int, int]:
    """Width and height in pixels; raises argparse.ArgumentTypeError where it is something else."""
    numbers = text.lower().split("x")
    if len(numbers) != 2 or not all(
        number.isdecimal() and LEAST_SIZE <= int(number) <= LARGEST_SIZE for number in numbers
    ):
        raise argparse.ArgumentTypeError(
            f"'{text}' is no size: two numbers of {LEAST_SIZE} to {LARGEST_SIZE}, as in 1280x800"
        )
    return int(numbers[0]), int(numbers[1])


def picture_name(scenario: str, time: float) -> str:
    """The file name of a picture, such as ``rope_t060.png`` or ``rope_t007.25.png``."""
    whole, _, fraction = f"{time:.3f}".partition(".")
    fraction = fraction.rstrip("0")
    return "{}_t{:0>3}{}.png".format(scenario, whole, "." + fraction if fraction else "")


def _take_all(scenario: Scenario, times: Sequence[float], arguments: argparse.Namespace) -> None:
    from deformable_manipulation.ros.picture import save_png
    from deformable_manipulation.ros.rviz_view import read_configuration
    from deformable_manipulation.ros.snapshot_studio import snapshot_studio

    source = arguments.config or rviz_configuration(
        find_scenario(arguments.scenario).resolve(), scenario
    )
    configuration = read_configuration(source, arguments.view, arguments.size)
    progress = ProgressDisplay(sys.stderr)
    with tempfile.TemporaryDirectory(prefix=NAME + "_") as directory:
        with snapshot_studio(scenario, configuration, arguments.size, directory) as studio:
            for time in times:
                print(f"{NAME}: running to {time:g} s", file=sys.stderr)
                try:
                    studio.go_to(time, progress)
                finally:
                    progress.close()
                print(f"{NAME}: taking the picture", file=sys.stderr)
                path = arguments.output / picture_name(scenario.name, time)
                save_png(studio.take(arguments.timeout), path, f"{scenario.name} at {time:g} s")
                print(path, flush=True)


if __name__ == "__main__":
    sys.exit(main())
