"""Which RViz configuration shows a scenario."""

from pathlib import Path
from typing import Optional

from deformable_manipulation.authoring.places import rviz_file_of
from deformable_manipulation.scenario.spec import Scenario
from deformable_manipulation.system.package_files import package_share_directory


def own_configuration(scenario: Scenario, scenario_file: Optional[Path] = None) -> Optional[Path]:
    """That of the scenario's file, if that is known; else the package's of its name, if any."""
    beside = [] if scenario_file is None else [rviz_file_of(scenario_file)]
    for path in (*beside, _of_package(scenario.name)):
        if path.is_file():
            return path
    return None


def rviz_configuration(scenario_file: Optional[Path], scenario: Scenario) -> Path:
    """Its own configuration; else the package's for objects of its type."""
    own = own_configuration(scenario, scenario_file)
    return own or _of_package(scenario.object.rviz_example)


def _of_package(name: str) -> Path:
    return package_share_directory() / "rviz" / "{}.rviz".format(name)
