"""The scenario file: reading it, checking it, writing it with everything filled in."""

from deformable_manipulation.reading.errors import Problem, ScenarioError
from deformable_manipulation.scenario.files import scenario_names
from deformable_manipulation.scenario.limits import PairLimits, leader_workspace, pair_limits
from deformable_manipulation.scenario.loader import (
    load_scenario,
    scenario_from_mapping,
    with_controller,
)
from deformable_manipulation.scenario.mapping import (
    controller_to_mapping,
    scenario_to_mapping,
    scenario_to_yaml,
)
from deformable_manipulation.system.package_files import package_share_directory

__all__ = [
    "PairLimits",
    "Problem",
    "ScenarioError",
    "controller_to_mapping",
    "leader_workspace",
    "load_scenario",
    "package_share_directory",
    "pair_limits",
    "scenario_from_mapping",
    "scenario_names",
    "scenario_to_mapping",
    "scenario_to_yaml",
    "with_controller",
]
