"""Which RViz configuration shows a scenario."""

from pathlib import Path

from deformable_manipulation.authoring.places import rviz_file_of
from deformable_manipulation.scenario.files import package_share_directory
from deformable_manipulation.scenario.spec import Scenario

# Of the package's own, for scenarios without one: their views look at the place of the templates.
_BY_TYPE = {"rod": "rope_one_assistant", "fabric": "fabric_three_assistants"}


def rviz_configuration(scenario_file: Path, scenario: Scenario) -> Path:
    """That of the scenario's file; else the package's of its name, or for objects of its type."""
    folder = package_share_directory() / "rviz"
    candidates = (rviz_file_of(scenario_file), folder / "{}.rviz".format(scenario.name))
    for path in candidates:
        if path.is_file():
            return path
    return folder / "{}.rviz".format(_BY_TYPE[scenario.object.type])
