"""Where scenarios are: by name, or by path."""

import os
from pathlib import Path
from typing import List

from deformable_manipulation.reading.errors import Problem, ScenarioError
from deformable_manipulation.reading.readers import nearest
from deformable_manipulation.system.package_files import package_share_directory

_PAPER_SCENARIOS = (
    "rope_one_assistant",
    "stiff_rod_one_assistant",
    "rope_two_assistants",
    "fabric_three_assistants",
)


def scenario_names() -> List[str]:
    """Names of the scenarios in ``config/scenarios``, those of the paper first.

    Raises FileNotFoundError if this package's files are not found.
    """
    names = [path.stem for path in _scenario_folder().glob("*.yaml")]
    order = {name: place for place, name in enumerate(_PAPER_SCENARIOS)}
    return sorted(names, key=lambda name: (order.get(name, len(order)), name))


def _scenario_folder() -> Path:
    return package_share_directory() / "config" / "scenarios"


def find_scenario(path_or_name: str) -> Path:
    """The file of a scenario: a path, or the bare name of one in ``config/scenarios``.

    Raises ScenarioError if there is none.
    """
    path = Path(path_or_name)
    if os.path.isfile(path):
        return path
    if os.path.exists(path) and not os.path.isdir(path):
        raise ScenarioError([Problem("", "is not a regular file")], str(path_or_name))
    is_bare_name = len(path.parts) == 1 and path.suffix in ("", ".yaml")
    if not is_bare_name and os.path.isdir(path):
        reason = "is a folder; name a scenario file in it"
        raise ScenarioError([Problem("", reason)], str(path_or_name))
    if not is_bare_name:
        raise ScenarioError([Problem("", "there is no such file")], str(path_or_name))
    try:
        folder = _scenario_folder()
    except FileNotFoundError as error:
        raise ScenarioError([Problem("", str(error))], str(path_or_name)) from error
    named = folder / "{}.yaml".format(path.stem)
    if not os.path.isfile(named):
        raise ScenarioError([Problem("", _unknown_name(path.stem, folder))], str(path_or_name))
    return named


def _unknown_name(name: str, folder: Path) -> str:
    known = sorted(entry.stem for entry in folder.glob("*.yaml"))
    return "there is no such file and no scenario with this name;{} scenarios: {}".format(
        nearest(name, known), ", ".join(known)
    )
