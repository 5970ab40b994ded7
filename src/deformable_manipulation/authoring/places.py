"""Where the three files of a scenario are: in a package like this one, or side by side anywhere."""

import dataclasses
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Tuple

MANIFEST = "package.xml"
_SCENARIOS = Path("config") / "scenarios"


@dataclasses.dataclass(frozen=True)
class Places:
    """The files of a scenario.

    ``launch_root`` is how launch files write the folder ``root`` that all three are in;
    ``package`` is the ROS package that it is the root of, or empty.
    """

    root: Path
    launch_root: str
    scenario: Path
    launch: Path
    rviz: Path
    package: str = ""

    @property
    def files(self) -> Tuple[Path, ...]:
        """All three."""
        return self.scenario, self.launch, self.rviz

    def in_launch_file(self, file: Path) -> str:
        """A file's name for launch files, with substitutions."""
        return "{}/{}".format(self.launch_root, file.relative_to(self.root).as_posix())


def new_places(folder: Path, name: str) -> Places:
    """Where the files of a new scenario go: side by side, or in the folders of a package's root.

    Raises:
        ValueError: the folder has a package.xml that tells no name.
    """
    manifest = folder / MANIFEST
    if not manifest.is_file():
        return Places(
            folder,
            "$(dirname)",
            folder / (name + ".yaml"),
            folder / (name + ".launch"),
            folder / (name + ".rviz"),
        )
    package = _package_name(manifest)
    return Places(
        folder,
        "$(find {})".format(package),
        folder / _SCENARIOS / (name + ".yaml"),
        folder / "launch" / (name + ".launch"),
        folder / "rviz" / (name + ".rviz"),
        package,
    )


def rviz_file_of(scenario_file: Path) -> Path:
    """Where the RViz configuration of a scenario's file is, if it has one."""
    folder = scenario_file.parent
    if folder.parts[-2:] == _SCENARIOS.parts:
        return folder.parent.parent / "rviz" / (scenario_file.stem + ".rviz")
    return scenario_file.with_suffix(".rviz")


def _package_name(manifest: Path) -> str:
    try:
        name = ElementTree.parse(str(manifest)).getroot().findtext("name", "").strip()
    except (ElementTree.ParseError, OSError, UnicodeDecodeError) as error:
        raise ValueError("{} cannot be read: {}".format(manifest, error)) from error
    if not name:
        raise ValueError("{} does not contain the name of the package".format(manifest))
    return name
