"""The command ``new_scenario``: scenario, launch and RViz files that run as they are."""

import argparse
import dataclasses
import os
import re
import shlex
import sys
from pathlib import Path
from typing import List, Mapping, Optional, Sequence

from deformable_manipulation.authoring.launch_file import launch_file
from deformable_manipulation.authoring.places import Places, new_places
from deformable_manipulation.authoring.rviz_choice import rviz_configuration
from deformable_manipulation.authoring.scenario_text import NoMaterial, moved_text
from deformable_manipulation.authoring.yaml_edit import replace_scalars
from deformable_manipulation.commands.arguments import command_parser, folder_name
from deformable_manipulation.commands.failure import fail
from deformable_manipulation.objects.kinds import KINDS
from deformable_manipulation.scenario import (
    ScenarioError,
    load_scenario,
    package_share_directory,
)
from deformable_manipulation.scenario.files import find_scenario
from deformable_manipulation.scenario.spec import Scenario
from deformable_manipulation.system.package_files import PACKAGE, ros_package
from deformable_manipulation.system.text_files import read_text

NAME = "new_scenario"
DESCRIPTION = """Make your own scenario: a scenario file with comments on what to change, a launch
file and an RViz configuration. They run without changes. They are written into one folder, or, if
that is the root of a catkin package, into its config/scenarios, launch and rviz."""
EXAMPLES = """examples:
  new_scenario my_rope                                    in this folder
  new_scenario my_sheet --object fabric --material felt --output my_sheet
  new_scenario my_hills --from rope_two_assistants        a copy of a scenario to change
  new_scenario my_rope --output ~/catkin_ws/src/my_package

exit status: 0 the files were written, 1 they were not (the reason is on stderr), 2 wrong usage
"""

_SETUP_VARIABLE = "DEFORMABLE_MANIPULATION_SETUP"  # set where with_environment sourced it itself

# REP-144, as for packages: the name becomes part of file names and of what roslaunch completes.
_SCENARIO_NAME = re.compile(r"[a-z](?:_?[a-z0-9])+")
_LONGEST_NAME = 100


class Refused(Exception):
    """The files cannot be made; the message says why."""


def main(argv: Optional[Sequence[str]] = None) -> int:
    """Run the command; returns its exit status."""
    arguments = _parse(argv)
    try:
        places = _make(arguments)
    except ScenarioError as error:
        print(error, file=sys.stderr)
        return 1
    except (Refused, OSError, ValueError) as error:
        return fail(NAME, str(error))
    for line in _next_steps(places, arguments.name):
        print(line)
    return 0


def _parse(argv: Optional[Sequence[str]]) -> argparse.Namespace:
    parser = command_parser(NAME, DESCRIPTION, EXAMPLES)
    parser.add_argument(
        "name", type=scenario_name, metavar="NAME", help="lower-case letters, digits and single _"
    )
    parser.add_argument(
        "--output",
        metavar="DIR",
        type=folder_name,
        default=Path("."),
        help="output folder, created if missing (default: the current one)",
    )
    origin = parser.add_mutually_exclusive_group()
    origin.add_argument(
        "--object", choices=KINDS, help=f"what is carried (default: {next(iter(KINDS))})"
    )
    origin.add_argument(
        "--from",
        dest="source",
        metavar="SCENARIO",
        help="the scenario to start from: a file, or the name of one of this package",
    )
    parser.add_argument(
        "--material", help="material of the object; docs/materials.md lists the materials"
    )
    return parser.parse_args(argv)


def scenario_name(text: str) -> str:
    """A name for a scenario; raises argparse.ArgumentTypeError for another text."""
    if _SCENARIO_NAME.fullmatch(text) and len(text) <= _LONGEST_NAME:
        return text
    words = re.findall(r"[a-z0-9]+", text.lower())
    better = "_".join(words).lstrip("0123456789_")[:_LONGEST_NAME].rstrip("_")
    hint = f"; try '{better}'" if _SCENARIO_NAME.fullmatch(better) else ""
    raise argparse.ArgumentTypeError(
        f"'{text}' is not a valid scenario name: use lower-case letters, digits and single "
        f"underscores, start with a letter, 2 to {_LONGEST_NAME} characters{hint}"
    )


def _make(arguments: argparse.Namespace) -> Places:
    """Make the three files, or none; returns where they are."""
    source = _source(arguments)
    original = load_scenario(source)
    places = new_places(arguments.output.expanduser().resolve(), arguments.name)
    _check_places(places)
    try:
        text = moved_text(
            read_text(source), source, places.scenario, arguments.name, arguments.material
        )
    except NoMaterial:
        raise Refused(
            f"--material: the object of {arguments.source} has no key material; add the key, and "
            "remove the values that the material defines"
        ) from None
    overrides = [] if arguments.material is None else [("object.material", arguments.material)]
    expected = dataclasses.replace(load_scenario(source, overrides), name=arguments.name)
    rviz = replace_scalars(
        read_text(rviz_configuration(source, original)),
        {("Visualization Manager", "Global Options", "Fixed Frame"): expected.frame},
    )
    launch = launch_file(
        expected, *(places.in_launch_file(file) for file in (places.scenario, places.rviz))
    )
    _write(dict(zip(places.files, (text, launch, rviz))), expected)
    return places


def _source(arguments: argparse.Namespace) -> Path:
    if arguments.source is not None:
        return find_scenario(arguments.source).resolve()
    kind = arguments.object or next(iter(KINDS))
    return package_share_directory() / "config" / "templates" / f"{kind}.yaml"


def _check_places(places: Places) -> None:
    if places.root.exists() and not places.root.is_dir():
        raise Refused(f"--output: {places.root} is not a folder")
    there = [str(file) for file in places.files if os.path.lexists(str(file))]
    if there:
        raise Refused("{} already exists; choose another name or folder".format(", ".join(there)))


def _write(texts: Mapping[Path, str], expected: Scenario) -> None:
    """Write the files; none is left where one cannot be written or does not mean what it should."""
    made: List[Path] = []
    try:
        for path, text in texts.items():
            path.parent.mkdir(parents=True, exist_ok=True)
            with open(path, "x", encoding="utf-8") as file:
                made.append(path)
                file.write(text)
        if load_scenario(made[0]) != expected:
            raise Refused(
                "the scenario cannot be copied automatically (does it use YAML aliases?); "
                f"copy the file by hand to {made[0]}"
            )
    except BaseException:
        for path in made:
            path.unlink()
        raise


def _next_steps(places: Places, name: str) -> List[str]:
    files = [os.path.relpath(str(file)) for file in places.files]
    scenario, launch, _ = map(shlex.quote, files)
    commands = [
        f"check_scenario {scenario}",
        f"run_scenario {scenario} --output {name}_run",
        f"plot_run {name}_run",
        f"rviz_snapshot {scenario}",
    ]
    return [
        *files,
        "next:",
        *(f"  {line}" for line in _environment(places)),
        *(f"  rosrun {PACKAGE} {command}" for command in commands),
        f"  roslaunch {launch}",
    ]


def _environment(places: Places) -> List[str]:
    """Lines for a shell in which the commands are not found yet."""
    lines = []
    setup = os.environ.get(_SETUP_VARIABLE)
    if setup:
        lines.append(f"source {shlex.quote(setup)}")
    if places.package and ros_package(places.package) is None:
        lines.append(f"# build and source the workspace of the package {places.package}")
    return lines
