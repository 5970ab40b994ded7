"""Replays a recording of a real object, and tells how far the simulated one is from it."""

import argparse
import json
import math
import sys
from pathlib import Path
from typing import Optional, Sequence, Tuple

from deformable_manipulation.commands.arguments import (
    add_set_argument,
    command_parser,
    folder_name,
    number,
)
from deformable_manipulation.commands.failure import fail
from deformable_manipulation.commands.output_folder import writable_folder
from deformable_manipulation.reading.errors import ScenarioError

NAME = "replay"
DESCRIPTION = """Drive the grips of a simulated rope or fabric as those of a real one were, and
compare the points that were measured with the same points of the simulation. Prints the mean error
per coordinate, the mean and the largest distance, and the mean while the object was at rest and
while it moved. Writes replay.png (shapes and distances over time), predicted.csv (in the format of
the recording), difference.json (the numbers), and replay.bag and replay.rviz, which show both
objects over time in RViz."""
EPILOG = """examples:
  replay swing.csv --object my_rope.yaml
  replay swing.csv --object my_rope.yaml --set object.damping=0 --set object.young_modulus=2e7
  replay swing.csv --object my_rope.yaml --held 0 --held 11,12    pinned, and clamped
  replay swing.csv --object my_rope.yaml --from 2 --to 7 --output out
  replay shake.csv --object my_cloth.yaml --held 0 --held 4       a cloth, by two vertices

  rosbag play --loop out/replay.bag & rviz -d out/replay.rviz     with a roscore

The format of a recording is in docs/real_objects.md.

exit status: 0 done, 1 the recording or the object cannot be used, 2 wrong usage
"""


def main(argv: Optional[Sequence[str]] = None) -> int:
    """Run the command; returns its exit status."""
    arguments = _parse(argv)
    # Imported late: SciPy and the compiled core load slowly, and wrong usage is reported at once.
    from deformable_manipulation._pbd import NonFiniteState
    from deformable_manipulation.replaying.measured_shapes import (
        MeasuredShapesError,
        read_measured_shapes,
    )
    from deformable_manipulation.replaying.object_file import load_object

    try:
        measured = load_object(arguments.object, arguments.set)
        shapes = read_measured_shapes(arguments.recording).between(arguments.start, arguments.end)
        return _replay(arguments, measured, shapes)
    except ScenarioError as error:
        print(error, file=sys.stderr)
    except (MeasuredShapesError, NonFiniteState) as error:
        fail(NAME, str(error))
    except OSError as error:
        fail(NAME, f"cannot write the results: {error}")
    return 1


def _replay(arguments, measured, shapes) -> int:
    from deformable_manipulation.replaying.difference import describe, difference
    from deformable_manipulation.replaying.measured_shapes import MeasuredShapesError
    from deformable_manipulation.replaying.overlay import Overlay
    from deformable_manipulation.replaying.replay import Replay, ReplayOptions

    if len(shapes.time) < 2:
        raise MeasuredShapesError(
            f"{arguments.recording}: fewer than two shapes between --from and --to"
        )
    options = ReplayOptions(
        held=arguments.held,
        start=arguments.begin,
        gravity=measured.gravity,
        solver=measured.solver,
        substeps=measured.substeps,
        aim=arguments.aim,
    )
    replay = Replay(measured.spec, shapes, options)
    softness = replay.softness(measured.spec)
    if softness:
        print(f"{NAME}: WARNING: {softness}", file=sys.stderr)
    folder = writable_folder(arguments.output or Path("output") / Path(arguments.recording).stem)
    whole = replay.run_whole(measured.spec)
    predicted = replay.measured(whole)
    found = difference(shapes, predicted)
    for line in describe(found.numbers):
        print(line)
    edges, _ = measured.spec.edges()
    _write(folder, Overlay(shapes, predicted, whole, edges), found)
    return 0


def _write(folder: Path, overlay, found) -> None:
    from deformable_manipulation.plots.replay_plot import plot_replay
    from deformable_manipulation.plots.style import save_figure
    from deformable_manipulation.replaying.measured_shapes import (
        MeasuredShapes,
        write_measured_shapes,
    )
    from deformable_manipulation.replaying.overlay import overlay_configuration, write_overlay_bag

    shapes, predicted = overlay.shapes, overlay.predicted
    save_figure(plot_replay(shapes, predicted, found), folder / "replay.png")
    write_measured_shapes(
        folder / "predicted.csv", MeasuredShapes(shapes.time, shapes.places, predicted)
    )
    text = json.dumps({name: _finite(value) for name, value in found.numbers.items()}, indent=2)
    (folder / "difference.json").write_text(text + "\n", encoding="utf-8")
    write_overlay_bag(folder / "replay.bag", overlay)
    (folder / "replay.rviz").write_text(overlay_configuration(overlay), encoding="utf-8")
    for name in ("replay.png", "predicted.csv", "difference.json", "replay.bag", "replay.rviz"):
        print(folder / name)


def _finite(value: float) -> Optional[float]:
    return value if value == value else None


def _parse(argv: Optional[Sequence[str]]) -> argparse.Namespace:
    parser = command_parser(NAME, DESCRIPTION, EPILOG)
    parser.add_argument("recording", help="CSV file of measured shapes")
    parser.add_argument(
        "--object",
        metavar="FILE",
        required=True,
        help="YAML file with a section object, such as a scenario, or the name of a scenario",
    )
    add_set_argument(parser, "replace a value of the file, as in object.damping=0")
    parser.add_argument(
        "--held",
        metavar="POINTS",
        type=held_points,
        action="append",
        help="points that one gripper holds, counted from 0: two or more of a rod are clamped, one "
        "is pinned, and so are all of a fabric; once per gripper (default: the first two and the "
        "last two of a rod)",
    )
    parser.add_argument(
        "--aim",
        metavar="Y,Z",
        type=_angles,
        action="append",
        default=[],
        help="angles [deg] about the grip's y and z axes at which it holds the object, as identify "
        "finds them; for all grippers, in their order (default: straight)",
    )
    parser.add_argument(
        "--begin",
        choices=("measured", "settled"),
        default="measured",
        help="begin in the first measured shape with its velocities (default), or at rest",
    )
    parser.add_argument(
        "--from",
        dest="start",
        metavar="T",
        type=number,
        default=float("-inf"),
        help="time [s] at which to begin (default: the first)",
    )
    parser.add_argument(
        "--to",
        dest="end",
        metavar="T",
        type=number,
        default=float("inf"),
        help="time [s] at which to end (default: the last)",
    )
    parser.add_argument(
        "--output",
        metavar="DIR",
        type=folder_name,
        help="output folder (default: output/NAME OF THE RECORDING)",
    )
    return parser.parse_args(argv)


def _angles(text: str) -> Tuple[float, ...]:
    try:
        angles = tuple(math.radians(float(item)) for item in text.split(","))
    except ValueError:
        angles = ()
    if len(angles) != 2 or not all(map(math.isfinite, angles)):
        raise argparse.ArgumentTypeError(f"'{text}' must be two angles [deg], as in 1.5,-3")
    return angles


def held_points(text: str) -> Tuple[int, ...]:
    """Points that a gripper holds; raises argparse.ArgumentTypeError where they are none."""
    from deformable_manipulation.replaying.grips import parse_held

    try:
        return parse_held(text)
    except ValueError:
        raise argparse.ArgumentTypeError(
            f"'{text}' must be numbers of points in their order, counted from 0, as in 0,1"
        ) from None
