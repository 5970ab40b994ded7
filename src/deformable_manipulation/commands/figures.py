"""Updates the measured numbers in the documentation, and lists the stale ones."""

import argparse
import sys
from pathlib import Path
from typing import List, Optional, Sequence

from deformable_manipulation.benchmarks.rivals.environment import checkout
from deformable_manipulation.commands.arguments import command_parser
from deformable_manipulation.commands.failure import fail
from deformable_manipulation.figures.excerpt import quote
from deformable_manipulation.figures.history import History, HistoryError
from deformable_manipulation.figures.present import machine_name, present_origin
from deformable_manipulation.figures.registry import (
    SUBJECTS_BY_BLOCK,
    VALIDATION,
    Subject,
    page_of,
)
from deformable_manipulation.figures.runs import MeasurementError
from deformable_manipulation.figures.state import examine, read_pages
from deformable_manipulation.markdown.block import BlockError, Provenance, write_block
from deformable_manipulation.system.interruption import exit_status, interruptible

NAME = "figures"
DESCRIPTION = """Measure the numbers that README.md and docs/ quote, and write them there with
machine, commit and date. Each table stands between <!-- figures: NAME ... --> and <!-- end -->."""
EPILOG = """examples:
  figures --check                   list the tables that are older than the code they measure
  figures scenarios terms           measure these tables again
  figures recovery --accept HEAD    after editing a table that no command can write

Blocks that are measured together are written together. The campaigns take hours.
exit status: 0 done, or with --check all tables are up to date; 1 failed, or some are not;
2 wrong usage
"""


def main(argv: Optional[Sequence[str]] = None) -> int:
    """Run the command; returns its exit status."""
    arguments = _parse(argv)
    with interruptible():
        try:
            if arguments.check:
                return _check(arguments.checkout, arguments.names)
            if arguments.accept:
                _accept(arguments)
            else:
                _measure(arguments.checkout, arguments.names)
        except (BlockError, HistoryError, MeasurementError, OSError) as error:
            return fail(NAME, str(error))
        except KeyboardInterrupt as interrupt:
            return exit_status(interrupt)
    return 0


def _parse(argv: Optional[Sequence[str]]) -> argparse.Namespace:
    blocks = "\n".join(f"  {name:20} {page_of(name)}" for name in SUBJECTS_BY_BLOCK)
    parser = command_parser(NAME, f"{DESCRIPTION}\n\ntables:\n{blocks}", EPILOG)
    parser.add_argument("names", metavar="NAME", nargs="*", help="a table; see the list above")
    parser.add_argument(
        "--check", action="store_true", help="list outdated tables (all of them without NAME)"
    )
    parser.add_argument(
        "--accept",
        metavar="COMMIT",
        help="keep the tables as they are and record that they were measured at this commit",
    )
    parser.add_argument(
        "--machine",
        metavar="TEXT",
        default=machine_name(),
        help="with --accept: what they were measured on",
    )
    parser.add_argument(
        "--checkout", metavar="DIR", type=Path, default=checkout(), help="default: %(default)s"
    )
    arguments = parser.parse_args(argv)
    unknown = [name for name in arguments.names if name not in SUBJECTS_BY_BLOCK]
    if unknown:
        parser.error(f"unknown table {', '.join(unknown)}")
    if not (arguments.check or arguments.names):
        parser.error("name a table, or use --check")
    if arguments.check and arguments.accept:
        parser.error("use either --check or --accept")
    return arguments


def _check(top: Path, names: Sequence[str]) -> int:
    findings = examine(top, names)
    for finding in findings:
        kind = "error" if finding.is_error else "stale"
        print(f"{kind}: {page_of(finding.name)}: {finding.name}: {finding.text}")
    if not findings:
        print("all tables are up to date")
    return 1 if findings else 0


def _accept(arguments: argparse.Namespace) -> None:
    history = History(arguments.checkout)
    commit, date = history.describe(arguments.accept)
    blocks = read_pages(arguments.checkout)
    for name in arguments.names:
        command = SUBJECTS_BY_BLOCK[name].command
        origin = Provenance(command, arguments.machine, commit, date)
        write_block(arguments.checkout / page_of(name), name, blocks[name].content, origin)


def _measure(top: Path, names: Sequence[str]) -> None:
    # Blocks that are measured together share their subject.
    subjects: List[Subject] = []
    for name in names:
        subject = SUBJECTS_BY_BLOCK[name]
        if subject not in subjects:
            subjects.append(subject)
    for subject in subjects:
        if subject.excerpt_of:
            _quote(top, subject)
        elif subject.measure:
            origin = present_origin(top, subject.command, subject.sources)
            for name, content in subject.measure(_say).items():
                write_block(top / page_of(name), name, content, origin)
                print(f"{page_of(name)}: {name}")
        else:
            raise MeasurementError(
                f"{', '.join(subject.pages)}: cannot be measured here; run: {subject.command}"
            )


def _quote(top: Path, subject: Subject) -> None:
    assert subject.excerpt_of is not None
    origin = read_pages(top)[subject.excerpt_of].provenance
    if origin is None:
        raise BlockError(f"{VALIDATION}: was never measured")
    for name, page in subject.pages.items():
        write_block(top / page, name, quote(top / VALIDATION), origin)
        print(f"{page}: {name}")


def _say(what: str) -> None:
    print(f"{NAME}: {what}", file=sys.stderr, flush=True)
