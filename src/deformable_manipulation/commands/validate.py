"""Compares the simulated rod with rod theory and writes a page of the results."""

import argparse
import sys
import time
from pathlib import Path
from typing import Any, Dict, Optional, Sequence

from deformable_manipulation.commands.arguments import command_parser, folder_name
from deformable_manipulation.system.interruption import exit_status, interruptible

NAME = "validate"
PAGE = "validation.md"
IMAGES = "images"
CASE_NAMES = (
    "hanging",
    "cantilever",
    "spatial",
    "twist",
    "free",
    "holds",
    "grips",
    "convergence",
    "motion",
    "viscosity",
    "natural_shape",
    "point_masses",
    "wrenches",
    "fabrics",
    "fabric_gradients",
)
DESCRIPTION = """Compare simulated rods and fabrics with independent solutions of their theory:
shapes, reactions, twist and motion. Writes validation.md and its figures,
images/validation_*.png."""
EPILOG = """examples:
  validate                               writes docs/validation.md, takes minutes
  validate --quick                       fewer segments, takes less than a minute
  validate --case hanging --case twist   only two cases

exit status: 0 all within tolerance, 1 a tolerance is missed or a file cannot be written,
2 wrong usage
"""


def main(argv: Optional[Sequence[str]] = None) -> int:
    """Run the command; returns its exit status."""
    arguments = _parse(argv)
    partial = arguments.quick or arguments.case
    folder = arguments.output or Path("output/validation" if partial else "docs")
    names = [name for name in CASE_NAMES if name in (arguments.case or CASE_NAMES)]
    with interruptible():
        try:
            results = _run_all(names, arguments.quick)
            path = _write(results, folder)
        except OSError as error:
            print(f"{NAME}: cannot write the results: {error}", file=sys.stderr)
            return 1
        except KeyboardInterrupt as interrupt:
            return exit_status(interrupt)
    missed = [check for result in results.values() for check in result.checks if not check.passed]
    for check in missed:
        print(
            f"{NAME}: missed: {check.quantity}: {check.error:.3g} {check.error_unit}, "
            f"tolerance {check.tolerance:.3g} {check.error_unit}",
            file=sys.stderr,
        )
    print(f"written to {path}")
    return 1 if missed else 0


def _parse(argv: Optional[Sequence[str]]) -> argparse.Namespace:
    parser = command_parser(NAME, DESCRIPTION, EPILOG)
    parser.add_argument(
        "--output",
        metavar="DIR",
        type=folder_name,
        help="folder of the page (default: docs; output/validation for --quick and --case)",
    )
    parser.add_argument(
        "--case",
        metavar="NAME",
        action="append",
        choices=CASE_NAMES,
        help="run only this case; can be given several times: " + ", ".join(CASE_NAMES),
    )
    parser.add_argument("--quick", action="store_true", help="fewer segments, substeps and cases")
    return parser.parse_args(argv)


def _run_all(names: Sequence[str], quick: bool) -> Dict[str, Any]:
    # Imported late: SciPy loads slowly, and a wrong argument is reported at once.
    from deformable_manipulation.validation.cases import run_case

    results = {}
    for number, name in enumerate(names, start=1):
        print(f"{NAME}: {name} ({number} of {len(names)})", file=sys.stderr, end=" ", flush=True)
        start = time.perf_counter()
        results[name] = run_case(name, quick)
        checks = results[name].checks
        passed = sum(check.passed for check in checks)
        taken = time.perf_counter() - start
        print(f"{passed} of {len(checks)} passed, {taken:.0f} s", file=sys.stderr)
    return results


def _write(results, folder: Path) -> Path:
    from deformable_manipulation.benchmarks.rivals.environment import checkout
    from deformable_manipulation.figures.present import present_origin
    from deformable_manipulation.validation.figures import draw, save
    from deformable_manipulation.validation.report import report

    (folder / IMAGES).mkdir(parents=True, exist_ok=True)
    links = {}
    for name, result in results.items():
        if result.panels:
            links[name] = f"{IMAGES}/validation_{name}.png"
            save(draw(result), folder / links[name])
    path = folder / PAGE
    origin = present_origin(checkout(), "scripts/validate")
    path.write_text(report(results, links, origin), encoding="utf-8")
    return path
