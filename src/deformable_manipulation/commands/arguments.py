"""Arguments that several commands have in common."""

import argparse
import math
import re
from pathlib import Path
from typing import List, Sequence, Tuple

from deformable_manipulation.reading.errors import Problem, ScenarioError, show
from deformable_manipulation.reading.overrides import Override
from deformable_manipulation.scenario.knowledge import MUJOCO, OWN

_WORLD = "knowledge.world"

# Where the next key of several begins: values may have blanks, too.
_NEXT_KEY = re.compile(r"\s+(?=\w+(?:\.\w+)*=)")


def command_parser(name: str, description: str, epilog: str) -> argparse.ArgumentParser:
    """The parser of a command, whose help keeps the line breaks of both texts."""
    return argparse.ArgumentParser(
        prog=name,
        description=description,
        epilog=epilog,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )


def add_scenario_arguments(
    parser: argparse.ArgumentParser,
    name: str = "scenario",
    description: str = "scenario file (YAML), or the name of a scenario of this package",
) -> None:
    """Add the scenario, and ``--set`` to replace values of it."""
    parser.add_argument(name, help=description)
    add_set_argument(parser, "replace a value of the scenario; use an index for list items")


def add_set_argument(parser: argparse.ArgumentParser, description: str) -> None:
    """Add ``--set``, which replaces values of a file."""
    parser.add_argument(
        "--set",
        metavar="KEY.PATH=VALUE",
        type=override,
        action="append",
        default=[],
        help=f"{description}; can be repeated",
    )


def add_world_argument(parser: argparse.ArgumentParser) -> None:
    """Add ``--world``, which :func:`scenario_overrides` takes in."""
    parser.add_argument(
        "--world",
        choices=(OWN, MUJOCO),
        help=f"what simulates the true object: this package ({OWN}) or another engine; the "
        f"controllers then see poses of the grips alone. Short for --set {_WORLD}=...",
    )


def scenario_overrides(arguments: argparse.Namespace) -> List[Override]:
    """What replaces values of the scenario: all of ``--set``, and ``--world``.

    Raises:
        ScenarioError: both say what the world is.
    """
    if arguments.world is None:
        return arguments.set
    for key, value in arguments.set:
        if key == _WORLD:
            text = f"cannot be set beside --world {arguments.world}; remove one of the two"
            raise ScenarioError([Problem(_WORLD, text, show(value))], "arguments")
    return [*arguments.set, (_WORLD, arguments.world)]


def override(text: str) -> Tuple[str, str]:
    """Split ``key.path=value``; raises argparse.ArgumentTypeError where it is not of that form."""
    key, sign, value = text.partition("=")
    if not key or not sign:
        raise argparse.ArgumentTypeError(
            f"'{text}' does not have the form key.path=value, as in controller.gain=2"
        )
    return key.strip(), value


def overrides(text: str) -> List[Tuple[str, str]]:
    """Split several ``key.path=value``, separated by blanks; values may have blanks in them.

    Raises:
        argparse.ArgumentTypeError: one is not of that form.
    """
    return [override(item) for item in _NEXT_KEY.split(text.strip()) if item]


def folder_name(text: str) -> Path:
    """The folder that a user names; raises argparse.ArgumentTypeError for an empty name."""
    if not text.strip():
        raise argparse.ArgumentTypeError("is empty; name a folder (. is the current one)")
    return Path(text)


def times_of(text: str) -> Sequence[float]:
    """Times [s] separated by commas; raises argparse.ArgumentTypeError where they are not."""
    try:
        times = [float(item) for item in text.split(",")]
    except ValueError:
        times = [-1.0]
    if not all(0.0 <= time < float("inf") for time in times):
        raise argparse.ArgumentTypeError(
            f"'{text}' is not a list of times: use numbers >= 0 and commas, as in 30,60,130"
        )
    return times


def number(text: str) -> float:
    """A finite number; raises argparse.ArgumentTypeError where it is none."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"'{text}' is not a number")
    return value
