"""A scenario's file that was copied, and still has the name of its original."""

from typing import Optional

from deformable_manipulation.scenario.files import find_scenario
from deformable_manipulation.scenario.spec import Scenario

# Files of runs and campaigns, which keep the name of their scenario.
_RECORDED = ("scenario", "worst")


def name_warning(scenario: Scenario, path_or_name: str) -> Optional[str]:
    """What is confusing about a scenario's name; None: nothing.

    Args:
        scenario: as it was read.
        path_or_name: what it was read from.
    """
    file_name = find_scenario(path_or_name).stem
    if scenario.name == file_name or file_name in _RECORDED:
        return None
    return (
        f"name: runs and pictures will be called '{scenario.name}', but the file is called "
        f"'{file_name}'"
    )
