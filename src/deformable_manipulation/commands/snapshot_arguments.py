"""The arguments of ``rviz_snapshot``."""

import argparse
from pathlib import Path
from typing import Optional, Sequence, Tuple

from deformable_manipulation.commands.arguments import (
    add_scenario_arguments,
    command_parser,
    folder_name,
    number,
    times_of,
)

NAME = "rviz_snapshot"
LEAST_SIZE, LARGEST_SIZE = 64, 8192  # pixels
SEPARATE, OVERLAID, SIDE_BY_SIDE, AUTO = LAYOUTS = ("separate", "overlaid", "side_by_side", "auto")
SIZE, SIZE_IN_A_ROW = (1280, 800), (640, 480)  # pixels
DESCRIPTION = """Save pictures or a video of a run as RViz shows it. A recorded run is shown as it
was recorded; a scenario is run in lock-step. The command uses its own ROS master and virtual
display, so it needs no screen and does not disturb other nodes."""
EXAMPLES = """examples:
  rviz_snapshot rope_one_assistant --times 30,60,130
  rviz_snapshot output/run --times 30,60,130,160 --layout overlaid
  rviz_snapshot output/run.bag --times 20,40,120,140 --layout side_by_side
  rviz_snapshot output/run --layout auto
  rviz_snapshot output/run --video run.mp4
  rviz_snapshot my_scenario.yaml --output figures --size 1920x1080 --view YZ
  rviz_snapshot rope_one_assistant --set controller.collision.offset=0.1

The pictures are named SCENARIO_tTIME.png or ..._LAYOUT.png; their paths are printed.
exit status: 0 all pictures are saved, 1 one is not (the reason is on stderr), 2 wrong usage
"""


def parse_arguments(argv: Optional[Sequence[str]]) -> argparse.Namespace:
    """Read the command line; leaves the process where it is wrong."""
    parser = command_parser(NAME, DESCRIPTION, EXAMPLES)
    add_scenario_arguments(
        parser,
        "source",
        "run folder or bag; or scenario file (YAML) or the name of a scenario of this package",
    )
    parser.add_argument(
        "--times",
        type=times_of,
        metavar="SECONDS",
        help="times of the pictures, separated by commas (default: half of the duration; for "
        "several times in one picture, the lowest distance, the largest error and others)",
    )
    parser.add_argument(
        "--layout",
        choices=LAYOUTS,
        default=SEPARATE,
        help="separate: one picture per time. overlaid: all in one picture, each in a color. "
        "side_by_side: all times in a row. auto: in a row for fabrics and moving obstacles, which "
        "would hide each other, otherwise overlaid (default: separate)",
    )
    parser.add_argument(
        "--video",
        metavar="FILE.mp4",
        type=video_path,
        help="film a recorded run; pictures are then taken only if --times is given",
    )
    parser.add_argument(
        "--speed",
        type=speed_of,
        metavar="FACTOR",
        help="speed of the video, as a multiple of real time (default: the video takes 20 s)",
    )
    parser.add_argument("--namespace", help="which run, if the bag holds several")
    _add_picture_arguments(parser)
    return parser.parse_args(argv)


def _add_picture_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--output",
        metavar="DIR",
        type=folder_name,
        default=Path("."),
        help="output folder (default: the current one)",
    )
    parser.add_argument(
        "--size",
        type=size_of,
        metavar="WIDTHxHEIGHT",
        help="size of a picture in pixels (default: 1280x800; in a row 640x480)",
    )
    parser.add_argument("--view", metavar="NAME", help="a saved view of the RViz configuration")
    parser.add_argument(
        "--config",
        metavar="FILE",
        type=Path,
        help="RViz configuration (default: that of the scenario; if it has none, a view that shows "
        "the object, its path and the obstacles nearby)",
    )
    parser.add_argument(
        "--timeout",
        type=number,
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
            f"'{text}' is not a size: use two numbers from {LEAST_SIZE} to {LARGEST_SIZE}, "
            "as in 1280x800"
        )
    return int(numbers[0]), int(numbers[1])


def speed_of(text: str) -> float:
    """A factor above 0; raises argparse.ArgumentTypeError where it is something else."""
    try:
        speed = float(text)
    except ValueError:
        speed = 0.0
    if not 0.0 < speed < float("inf"):
        raise argparse.ArgumentTypeError(f"'{text}' is not a speed: use a number above 0, as in 8")
    return speed


def video_path(text: str) -> Path:
    """The path of an MP4 file; raises argparse.ArgumentTypeError where it is something else."""
    path = Path(text)
    if path.suffix.lower() != ".mp4":
        raise argparse.ArgumentTypeError(f"'{text}' does not end with .mp4")
    return path
