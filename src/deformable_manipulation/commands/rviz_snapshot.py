"""Saves pictures and videos of a scenario or a recorded run as RViz shows it, without a screen."""

import argparse
import sys
import tempfile
from functools import partial
from pathlib import Path
from typing import Optional, Sequence, Tuple

from deformable_manipulation.commands.arguments import add_scenario_arguments, times_of
from deformable_manipulation.commands.failure import fail
from deformable_manipulation.commands.output_folder import writable_folder
from deformable_manipulation.commands.snapshot_source import SnapshotSource, read_source
from deformable_manipulation.interruption import exit_status, interruptible
from deformable_manipulation.recording import RunDataError
from deformable_manipulation.scenario import ScenarioError, package_share_directory

NAME = "rviz_snapshot"
DEFAULT_CONFIGURATION = "rope_one_assistant"  # of planar obstacles
SPATIAL_CONFIGURATION = "fabric_three_assistants"
LEAST_SIZE, LARGEST_SIZE = 64, 8192  # pixels
LAYOUTS = ("separate", "overlaid", "side_by_side")
DESCRIPTION = """Save pictures, or a video, of a run as RViz shows it. A recorded run is shown as it
was; a scenario is run in lock-step for the pictures. On a ROS master and a virtual display of its
own: nothing that runs already is disturbed, and no screen is needed."""
EXAMPLES = """examples:
  rviz_snapshot rope_one_assistant --times 30,60,130
  rviz_snapshot output/run --times 30,60,130,160 --layout overlaid
  rviz_snapshot output/run.bag --times 20,40,120,140 --layout side_by_side --size 640x480
  rviz_snapshot output/run --video run.mp4
  rviz_snapshot my_scenario.yaml --output figures --size 1920x1080 --view YZ
  rviz_snapshot rope_one_assistant --set controller.collision.offset=0.1

The pictures are named SCENARIO_tTIME.png or ..._LAYOUT.png; their paths are printed.
exit status: 0 every picture is saved, 1 one is not (the reason is on stderr), 2 wrong usage
"""


def main(argv: Optional[Sequence[str]] = None) -> int:
    """Run the command; returns its exit status."""
    arguments = _parse(argv)
    try:
        source = read_source(arguments.source, arguments.set, arguments.namespace)
        first, last = source.time_range
        _check(arguments, source)
    except ScenarioError as error:
        print(error, file=sys.stderr)
        return 1
    except (RunDataError, ValueError) as error:
        return fail(NAME, str(error))
    except OSError as error:
        return fail(NAME, f"cannot write the pictures: {error}")
    if arguments.times is None and not arguments.video:
        arguments.times = [0.5 * (first + last)]
    # Imported late: ROS takes longer to load than a mistake in the arguments to be told.
    from deformable_manipulation.ros.program import ProgramError

    with interruptible():
        try:
            _make(source, arguments)
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
    add_scenario_arguments(
        parser,
        "source",
        "run folder or bag; or scenario file (YAML) or the name of a scenario of this package",
    )
    parser.add_argument(
        "--times",
        type=times_of,
        metavar="SECONDS",
        help="when to take pictures, separated by commas (default: half of the duration)",
    )
    parser.add_argument(
        "--layout",
        choices=LAYOUTS,
        default=LAYOUTS[0],
        help="a picture of each time, or all in one: over each other, the earlier ones paler, or "
        "in a row; with their times (default: separate)",
    )
    parser.add_argument(
        "--video",
        metavar="FILE.mp4",
        type=video_path,
        help="film a recorded run; pictures are taken only of --times then",
    )
    parser.add_argument(
        "--speed",
        type=speed_of,
        metavar="FACTOR",
        help="of the video, as a multiple of the run's (default: such that it lasts 20 s)",
    )
    parser.add_argument("--namespace", help="which run, where a bag holds several side by side")
    _add_picture_arguments(parser)
    return parser.parse_args(argv)


def _add_picture_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--output", metavar="DIR", type=Path, default=Path("."), help="folder (default: this one)"
    )
    parser.add_argument(
        "--size",
        type=size_of,
        default=(1280, 800),
        metavar="WIDTHxHEIGHT",
        help="of a picture, in pixels (default: 1280x800)",
    )
    parser.add_argument("--view", metavar="NAME", help="a saved view of the RViz configuration")
    parser.add_argument(
        "--config",
        metavar="FILE",
        type=Path,
        help="RViz configuration (default: that of the scenario; where it has none, a view that "
        "holds the object, its way and the obstacles near that)",
    )
    parser.add_argument(
        "--timeout",
        type=float,
        default=60.0,
        metavar="SECONDS",
        help="how long to wait for each picture (default: 60)",
    )


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


def speed_of(text: str) -> float:
    """A factor above 0; raises argparse.ArgumentTypeError where it is something else."""
    try:
        speed = float(text)
    except ValueError:
        speed = 0.0
    if not 0.0 < speed < float("inf"):
        raise argparse.ArgumentTypeError(f"'{text}' is no speed: a number above 0, as in 8")
    return speed


def video_path(text: str) -> Path:
    """The path of an MP4 file; raises argparse.ArgumentTypeError where it is something else."""
    path = Path(text)
    if path.suffix.lower() != ".mp4":
        raise argparse.ArgumentTypeError(f"'{text}' does not end with .mp4")
    return path


def _check(arguments: argparse.Namespace, source: SnapshotSource) -> None:
    """What would be told only after the run otherwise. Raises ValueError, OSError."""
    first, last = source.time_range
    if arguments.times is not None:
        arguments.times = sorted(set(arguments.times))
        if arguments.times[0] < first - 1e-9 or arguments.times[-1] > last + 1e-9:
            wrong = arguments.times[-1] if arguments.times[-1] > last else arguments.times[0]
            place = "after the end" if wrong > last else "before the start"
            what = "scenario" if source.frames is None else "run"
            raise ValueError(
                f"--times: {wrong:g} s is {place} of the {what}; allowed: {first:g} to {last:g} s"
            )
    if arguments.video:
        if source.frames is None:
            raise ValueError(
                "--video: films recorded runs; record it first: "
                f"run_scenario {arguments.source} --output DIR, then rviz_snapshot DIR --video ..."
            )
        writable_folder(arguments.video.parent)
    elif arguments.speed is not None:
        raise ValueError("--speed: is that of --video FILE.mp4, which is not given")
    if arguments.times is not None or not arguments.video:
        writable_folder(arguments.output)


def own_configuration(scenario: str) -> Optional[Path]:
    """The RViz configuration of a scenario of this package; None: it has none."""
    path = package_share_directory() / "rviz" / f"{scenario}.rviz"
    return path if path.is_file() else None


def _configuration(source: SnapshotSource, arguments: argparse.Namespace) -> dict:
    """RViz's configuration, as of YAML. Raises ProgramError."""
    from deformable_manipulation.ros.rviz_view import read_configuration
    from deformable_manipulation.ros.scene_view import fitted, plane_of

    path = arguments.config or own_configuration(source.scenario.name)
    if path is not None:
        return read_configuration(path, arguments.view, arguments.size)
    plane = plane_of(source.scenario)
    other = DEFAULT_CONFIGURATION if plane in ("yz", "xz") else SPATIAL_CONFIGURATION
    configuration = read_configuration(own_configuration(other), arguments.view, arguments.size)
    return fitted(configuration, source.bounds(), arguments.size, plane)


def _make(source: SnapshotSource, arguments: argparse.Namespace) -> None:
    from deformable_manipulation.commands.snapshot_pictures import SnapshotPictures
    from deformable_manipulation.ros.snapshot_studio import snapshot_studio
    from deformable_manipulation.ros.video_file import require_ffmpeg

    if arguments.video:
        require_ffmpeg()
    configuration = _configuration(source, arguments)
    leader = source.scenario.agents[source.scenario.leader_index].name
    with tempfile.TemporaryDirectory(prefix=NAME + "_") as directory:
        open_run = partial(source.open, directory)
        with snapshot_studio(open_run, leader, arguments.size, directory) as studio:
            pictures = SnapshotPictures(source, studio, configuration, arguments)
            if arguments.times:
                pictures.take(arguments.times, arguments.layout)
            if arguments.video:
                pictures.film(arguments.video, arguments.speed)
