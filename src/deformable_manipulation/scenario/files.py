"""Where files are: this package's share directory, scenarios by name, files a scenario names."""

import os
from pathlib import Path
from typing import List, Optional

from deformable_manipulation.scenario.errors import Problem, ScenarioError
from deformable_manipulation.scenario.readers import nearest

PACKAGE = "deformable_manipulation"
_PACKAGE_SCHEME = "package://"
_PAPER_SCENARIOS = (
    "rope_one_assistant",
    "stiff_rod_one_assistant",
    "rope_two_assistants",
    "fabric_three_assistants",
)


def package_share_directory() -> Path:
    """The directory that holds ``config/``: of the checkout, or ``share/`` of an install space.

    Raises FileNotFoundError where there is neither and the ROS package path does not know it.
    """
    for parent in Path(__file__).resolve().parents:
        for candidate in (parent, parent / "share" / PACKAGE):
            if _is_this_package(candidate):
                return candidate
    directory = _ros_package(PACKAGE)
    if directory is None:
        raise FileNotFoundError(
            "the files of package {} are not found; source the workspace's setup.bash".format(
                PACKAGE
            )
        )
    return directory


def _is_this_package(directory: Path) -> bool:
    manifest = directory / "package.xml"
    return manifest.is_file() and "<name>{}</name>".format(PACKAGE) in manifest.read_text(
        encoding="utf-8"
    )


def _ros_package(name: str) -> Optional[Path]:
    """The directory of a ROS package, None without ROS or without that package."""
    try:
        import rospkg
    except ImportError:
        return None
    try:
        return Path(rospkg.RosPack().get_path(name))
    except rospkg.ResourceNotFound:
        return None


def resolve_file(text: str, directory: Path) -> Path:
    """The path that a scenario's text means: relative to ``directory``, absolute or package://.

    Raises FileNotFoundError where the package is unknown; the file itself need not exist.
    """
    if not text.startswith(_PACKAGE_SCHEME):
        return directory / text
    package, _, rest = text[len(_PACKAGE_SCHEME) :].partition("/")
    root = package_share_directory() if package == PACKAGE else _ros_package(package)
    if root is None:
        raise FileNotFoundError("there is no ROS package '{}'".format(package))
    return root / rest


def scenario_names() -> List[str]:
    """Names of the scenarios in ``config/scenarios``, those of the paper first.

    Raises FileNotFoundError where this package's files are not found.
    """
    names = [path.stem for path in _scenario_folder().glob("*.yaml")]
    order = {name: place for place, name in enumerate(_PAPER_SCENARIOS)}
    return sorted(names, key=lambda name: (order.get(name, len(order)), name))


def _scenario_folder() -> Path:
    return package_share_directory() / "config" / "scenarios"


def find_scenario(path_or_name: str) -> Path:
    """The file of a scenario: a path, or the bare name of one in ``config/scenarios``.

    Raises ScenarioError where there is none.
    """
    path = Path(path_or_name)
    if os.path.isfile(path):
        return path
    if os.path.exists(path) and not os.path.isdir(path):
        raise ScenarioError([Problem("", "is no regular file")], str(path_or_name))
    is_bare_name = len(path.parts) == 1 and path.suffix in ("", ".yaml")
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
    return "there is no such file, and no scenario of this name;{} scenarios: {}".format(
        nearest(name, known), ", ".join(known)
    )
