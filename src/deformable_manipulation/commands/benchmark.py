"""Measures the speed of the package, compared with other libraries on the same work."""

import argparse
import sys
from pathlib import Path
from typing import Optional, Sequence

from deformable_manipulation.benchmarks.machine import describe_machine, load, load_warning
from deformable_manipulation.benchmarks.report import Report
from deformable_manipulation.benchmarks.rivals.environment import (
    checkout,
    default_environment,
    install,
)
from deformable_manipulation.benchmarks.subject import SUBJECTS, Request
from deformable_manipulation.commands.arguments import folder_name
from deformable_manipulation.commands.failure import fail
from deformable_manipulation.figures.present import present_origin
from deformable_manipulation.markdown.block import BlockError
from deformable_manipulation.system.interruption import exit_status, interruptible

NAME = "benchmark"
DOCUMENT = Path("docs") / "benchmarks.md"
EPILOG = """examples:
  benchmark rod                                  tables on the terminal
  benchmark rod --output results                 also as JSON, CSV and Markdown
  benchmark qp --quick                           fewer and shorter repetitions
  benchmark rod --update-docs                    also in docs/benchmarks.md, with the machine
  benchmark --install-rivals                     install the other libraries

Run nothing else on the machine while it measures. docs/benchmarks.md explains the method.
exit status: 0 measured and written; 1 failed (the reason is on stderr); 2 wrong usage
"""


def main(argv: Optional[Sequence[str]] = None) -> int:
    """Run the command; returns its exit status."""
    arguments = _parse(argv)
    with interruptible():
        try:
            if arguments.install_rivals:
                install(arguments.rivals)
            if arguments.subject:
                _measure(arguments)
        except (BlockError, RuntimeError) as error:
            # RuntimeError: no environment, or a simulation that broke down.
            return fail(NAME, str(error))
        except OSError as error:
            return fail(NAME, f"cannot write the results: {error}")
        except ImportError as error:
            return fail(NAME, f"cannot measure {arguments.subject}: {error}")
        except KeyboardInterrupt as interrupt:
            return exit_status(interrupt)
    return 0


def _parse(argv: Optional[Sequence[str]]) -> argparse.Namespace:
    subjects = "\n".join(f"  {name:10} {subject.summary}" for name, subject in SUBJECTS.items())
    parser = argparse.ArgumentParser(
        prog=NAME,
        description="Measure the speed of the package, compared with other libraries on the same "
        "work.\n\nsubjects:\n" + subjects,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("subject", nargs="?", choices=list(SUBJECTS), help="what to measure")
    parser.add_argument(
        "--quick", action="store_true", help="only a few short repetitions, for a rough result"
    )
    parser.add_argument(
        "--output",
        metavar="DIR",
        type=folder_name,
        help="write JSON, CSV and Markdown into a folder",
    )
    parser.add_argument(
        "--update-docs",
        metavar="FILE",
        type=Path,
        nargs="?",
        const=checkout() / DOCUMENT,
        help=f"write the tables into their blocks of a document (default: {DOCUMENT})",
    )
    parser.add_argument(
        "--rivals",
        metavar="DIR",
        type=Path,
        default=default_environment(),
        help="virtual environment of the other libraries (default: %(default)s)",
    )
    parser.add_argument(
        "--install-rivals", action="store_true", help="create that environment, then continue"
    )
    arguments = parser.parse_args(argv)
    if not (arguments.subject or arguments.install_rivals):
        parser.error(f"name a subject ({', '.join(SUBJECTS)}) or give --install-rivals")
    return arguments


def _measure(arguments: argparse.Namespace) -> None:
    subject = SUBJECTS[arguments.subject]
    # Taken before: what is measured adds to the load.
    machine = describe_machine(subject.libraries)
    _warn(load())
    request = Request(arguments.quick, arguments.rivals, _say)
    report = Report(arguments.subject, subject.measure(request), machine)
    for table in report.tables:
        print("\n" + table.terminal())
    if arguments.output:
        for path in report.write(arguments.output):
            print(path)
    if arguments.update_docs:
        command = f"scripts/benchmark {arguments.subject} --update-docs"
        report.update(arguments.update_docs, present_origin(checkout(), command))
        print(arguments.update_docs)


def _warn(value: float) -> None:
    warning = load_warning(value)
    if warning:
        print(f"{NAME}: {warning}", file=sys.stderr)


def _say(what: str) -> None:
    print(f"{NAME}: {what}", file=sys.stderr, flush=True)
