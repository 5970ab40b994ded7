"""Fits the parameters of a simulated rope to recordings of a real one."""

import argparse
import json
import math
import sys
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from typing import List, Optional, Sequence

from deformable_manipulation.commands.arguments import (
    add_set_argument,
    command_parser,
    folder_name,
)
from deformable_manipulation.commands.failure import fail
from deformable_manipulation.commands.output_folder import writable_folder
from deformable_manipulation.commands.progress import ProgressDisplay
from deformable_manipulation.commands.replay import held_points
from deformable_manipulation.reading.errors import ScenarioError

NAME = "identify"
FITTED = (
    "young_modulus",
    "torsion_modulus",
    "bending_retardation_time",
    "drag_coefficient",
    "damping",
    "natural_curvature",
    "aim",
)
USUAL = ("young_modulus", "bending_retardation_time", "aim")
DESCRIPTION = """Fit a simulated rope or rod to recordings of a real one: bending stiffness over
mass, damping, the curvature without load, and the angles at which the grippers hold it. Windows
of all recordings are replayed; a coarse grid comes first, then robust least squares. Prints
values with standard deviations, what the data do not tell, and how well recordings are
predicted that are left out of the fit. Writes object.yaml (a section object), report.md and
identification.json."""
EPILOG = """examples:
  identify swing_*.csv --object my_rope.yaml
  identify swing.csv --object my_rope.yaml --fit young_modulus,damping --window 2
  replay other.csv --object output/identification/object.yaml --aim=-0.2,5.0 --aim=-1.7,-2.8

The format of a recording is in docs/real_objects.md.

exit status: 0 done, 1 a recording or the object cannot be used, 2 wrong usage
"""


def main(argv: Optional[Sequence[str]] = None) -> int:
    """Run the command; returns its exit status."""
    arguments = _parse(argv)
    # Imported late: SciPy and the compiled core load slowly, and wrong usage is reported at once.
    from deformable_manipulation.replaying.measured_shapes import MeasuredShapesError
    from deformable_manipulation.replaying.object_file import load_object

    try:
        measured = load_object(arguments.object, arguments.set)
        return _identify(arguments, measured)
    except ScenarioError as error:
        print(error, file=sys.stderr)
    except MeasuredShapesError as error:
        fail(NAME, str(error))
    except BrokenProcessPool:
        fail(NAME, "a worker ended, perhaps for lack of memory; try fewer --workers")
    except OSError as error:
        fail(NAME, f"cannot write the results: {error}")
    return 1


def _identify(arguments, measured) -> int:
    from deformable_manipulation.campaign.workers import cores
    from deformable_manipulation.identification.identify import identify
    from deformable_manipulation.identification.parameters import AIM, CURVATURE, Parameters
    from deformable_manipulation.identification.problem import windows_of
    from deformable_manipulation.identification.workers import worker_map
    from deformable_manipulation.replaying.measured_shapes import read_measured_shapes
    from deformable_manipulation.replaying.replay import ReplayOptions, default_held

    recordings = [read_measured_shapes(path) for path in arguments.recordings]
    held = arguments.held or default_held(len(recordings[0].arc_lengths))
    options = ReplayOptions(
        held=held,
        gravity=measured.gravity,
        solver=measured.solver,
        substeps=measured.substeps,
    )
    material = tuple(name for name in arguments.fit if name not in (AIM, CURVATURE))
    grips = len(held) if AIM in arguments.fit else 0
    curved = CURVATURE in arguments.fit
    shape = measured.spec.natural_shape
    if curved and shape is not None and shape.points:
        fail(NAME, "object.natural_shape has points: --fit natural_curvature needs numbers")
        return 1
    parameters = Parameters(measured.spec, material, grips, curved)
    windows = windows_of(recordings, parameters, options, arguments.window)
    folder = writable_folder(arguments.output or Path("output/identification"))
    progress = ProgressDisplay(sys.stderr)
    folds = min(arguments.folds, len(recordings))
    try:
        with worker_map(arguments.workers or cores()) as each:
            found = identify(parameters, windows, folds, progress, each)
    finally:
        progress.close()
    _write(folder, found, arguments.recordings, len(windows))
    return 0


def _write(folder: Path, found, recordings: Sequence[str], windows: int) -> None:
    from deformable_manipulation.identification.findings import (
        object_section,
        report,
        statements,
        values,
    )

    for name, value, spread in values(found):
        print(f"{name:32} {value:>16}  {spread}")
    for sentence in statements(found):
        print(sentence)
    numbers = {
        "parameters": found.parameters.names,
        "vector": list(map(float, found.fit.vector)),
        "deviations": [None if math.isnan(x) else float(x) for x in found.fit.deviations],
        "at_bounds": found.parameters.at_bounds(found.fit.vector).tolist(),
        "errors": {key: None if math.isnan(x) else x for key, x in found.errors.items()},
        "left_out": found.left_out,
    }
    texts = {
        "object.yaml": object_section(found),
        "report.md": report(found, recordings, windows),
        "identification.json": json.dumps(numbers, indent=2) + "\n",
    }
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8")
        print(folder / name)


def _parse(argv: Optional[Sequence[str]]) -> argparse.Namespace:
    parser = command_parser(NAME, DESCRIPTION, EPILOG)
    parser.add_argument("recordings", nargs="+", metavar="recording", help="CSV files")
    parser.add_argument(
        "--object",
        metavar="FILE",
        required=True,
        help="YAML file with a section object to begin with, or the name of a scenario",
    )
    add_set_argument(parser, "replace a value of the file, as in object.damping=0")
    parser.add_argument(
        "--fit",
        metavar="NAMES",
        type=_fitted,
        default=list(USUAL),
        help="what is fitted, separated by commas: {} (default: {})".format(
            ", ".join(FITTED), ",".join(USUAL)
        ),
    )
    parser.add_argument(
        "--held",
        metavar="POINTS",
        type=held_points,
        action="append",
        help="points that one gripper holds, as for replay",
    )
    parser.add_argument(
        "--window",
        metavar="S",
        type=_positive,
        default=5.0,
        help="length [s] of the pieces that are replayed, each from its first shape (default: 5)",
    )
    parser.add_argument(
        "--folds",
        metavar="K",
        type=_folds,
        default=3,
        help="parts of the recordings that are left out in turn; 0: none (default: 3)",
    )
    parser.add_argument(
        "--workers", type=_count, metavar="N", help="processes (default: one per core)"
    )
    parser.add_argument(
        "--output",
        metavar="DIR",
        type=folder_name,
        help="output folder (default: output/identification)",
    )
    return parser.parse_args(argv)


def _fitted(text: str) -> List[str]:
    names = [name.strip() for name in text.split(",")]
    unknown = [name for name in names if name not in FITTED]
    if unknown or len(set(names)) < len(names):
        raise argparse.ArgumentTypeError(
            f"'{text}' must be some of {', '.join(FITTED)}, separated by commas"
        )
    return names


def _count(text: str) -> int:
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"'{text}' must be a whole number >= 1")
    return int(text)


def _folds(text: str) -> int:
    if not text.isdecimal():
        raise argparse.ArgumentTypeError(f"'{text}' must be a whole number >= 0")
    return int(text)


def _positive(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0.0 < value < math.inf:
        raise argparse.ArgumentTypeError(f"'{text}' must be a number > 0 [s]")
    return value
