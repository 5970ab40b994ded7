"""Fits the parameters of a simulated rope to recordings of a real one."""

import argparse
import itertools
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
FITTED = {  # by the object's type
    "rod": (
        "young_modulus",
        "torsion_modulus",
        "bending_retardation_time",
        "drag_coefficient",
        "damping",
        "natural_curvature",
        "aim",
    ),
    "fabric": ("stretching_compliance", "bending_compliance", "damping"),
}
USUAL = {
    "rod": ("young_modulus", "bending_retardation_time", "aim"),
    "fabric": ("bending_compliance", "damping"),
}
DESCRIPTION = """Fit a simulated object to recordings of a real one. Of a rope or rod: bending
stiffness over mass, damping, the curvature without load, and the angles at which the grippers
hold it; of a fabric: compliances and damping. Windows
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
    from deformable_manipulation.identification.problem import windows_of
    from deformable_manipulation.identification.workers import worker_map
    from deformable_manipulation.replaying.measured_shapes import read_measured_shapes
    from deformable_manipulation.replaying.replay import ReplayOptions

    recordings = [read_measured_shapes(path) for path in arguments.recordings]
    options = ReplayOptions(
        held=arguments.held,
        gravity=measured.gravity,
        solver=measured.solver,
        substeps=measured.substeps,
    )
    parameters = _parameters(arguments, measured.spec)
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


def _parameters(arguments, spec):
    """What is fitted to the object. Raises MeasuredShapesError."""
    from deformable_manipulation.identification.material_parameters import MaterialParameters
    from deformable_manipulation.identification.parameters import AIM, CURVATURE, Parameters
    from deformable_manipulation.replaying.driven_rod import USUALLY_HELD
    from deformable_manipulation.replaying.measured_shapes import MeasuredShapesError

    fitted = arguments.fit or USUAL[spec.type]
    others = [name for name in fitted if name not in FITTED[spec.type]]
    if others:
        raise MeasuredShapesError(
            f"--fit {','.join(others)}: the object is a {spec.type}, of which "
            f"{', '.join(FITTED[spec.type])} can be fitted"
        )
    material = tuple(name for name in fitted if name not in (AIM, CURVATURE))
    if spec.type != "rod":
        return MaterialParameters(spec, material)
    shape = spec.natural_shape
    if CURVATURE in fitted and shape is not None and shape.points:
        raise MeasuredShapesError(
            "object.natural_shape has points: --fit natural_curvature needs numbers"
        )
    grips = len(arguments.held or USUALLY_HELD) if AIM in fitted else 0
    return Parameters(spec, material, grips, CURVATURE in fitted)


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
        help="what is fitted, separated by commas: "
        + "; ".join(
            f"of a {kind} {', '.join(names)} (default: {','.join(USUAL[kind])})"
            for kind, names in FITTED.items()
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
    known = list(dict.fromkeys(itertools.chain(*FITTED.values())))
    if not set(names) <= set(known) or len(set(names)) < len(names):
        raise argparse.ArgumentTypeError(
            f"'{text}' must be some of {', '.join(known)}, separated by commas"
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
