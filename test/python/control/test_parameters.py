"""The controller's parameters on their way to the C++ core: none is forgotten."""

import copy
import dataclasses

import pytest
import yaml

from deformable_manipulation import _control
from deformable_manipulation.control.parameters import native_parameters
from deformable_manipulation.reading.parameter import declared_below
from deformable_manipulation.scenario import load_scenario
from deformable_manipulation.scenario.barriers import BARRIERS
from deformable_manipulation.scenario.controller import ControllerSpec

# A section of each barrier, and whatever else, that a scenario may leave out.
OPTIONAL = {
    "workspace": {"planes": [{"point": [0, 0, 9], "normal": [0, 0, -1]}]},
    "bending": {"min_radius": 0.01},
    "grip_force": {"max_force": 100.0},
    "grip_torque": {"max_torque": 100.0},
    "twist": {"max_twist": 100.0},
    "tension": {"max_tension": 100.0},
    "strain": {"max_strain": 1.0},
    "wrench_watch": {"max_force": 100.0, "max_torque": 100.0},
}
DECLARED = [
    (path, declaration)
    for path, declaration in declared_below(ControllerSpec)
    if path[:2] not in {("workspace", "planes"), ("workspace", "spheres")} or len(path) == 2
]


@pytest.fixture(scope="module")
def parameters():
    """With every barrier that there is."""
    overrides = [("controller." + name, yaml.safe_dump(OPTIONAL[name])) for name in OPTIONAL]
    scenario = load_scenario("rope_one_assistant", overrides)
    missing = set(BARRIERS) - set(scenario.controller.barriers)
    assert not missing, "add a section of each of them to OPTIONAL"
    return native_parameters(scenario, ["assistant_1"], True)


def without(mapping, path):
    """The section without one key."""
    changed = copy.deepcopy(mapping)
    section = changed
    for key in path[:-1]:
        section = section[key]
    del section[path[-1]]
    return changed


def test_there_is_a_native_barrier_of_each_name():
    assert set(_control.barrier_names()) == set(BARRIERS)


def test_a_barrier_that_may_be_missing_has_no_live_parameters():
    with pytest.raises(ValueError, match="barrier proximity: min_distance must not be live"):
        dataclasses.replace(BARRIERS["proximity"], default=None)


@pytest.mark.parametrize("path, declaration", DECLARED, ids=lambda each: str(each)[:40])
def test_the_core_reads_what_is_declared_as_native_and_nothing_else(parameters, path, declaration):
    changed = without(parameters.controller, path)
    if declaration.native:
        with pytest.raises(ValueError, match=r"controller\." + r"\.".join(path)):
            _control.TeamController(changed, parameters.team)
    else:
        _control.TeamController(changed, parameters.team)


@pytest.mark.parametrize("barrier", ["overstretch", "proximity"])
def test_what_a_barrier_derives_is_needed(parameters, barrier):
    with pytest.raises(ValueError, match=f"controller.{barrier}.limits"):
        _control.TeamController(
            without(parameters.controller, (barrier, "limits")), parameters.team
        )


@pytest.mark.parametrize("key", ["agents", "leader", "assistants", "commanded", "references"])
def test_the_team_is_needed(parameters, key):
    with pytest.raises(ValueError, match=f"team.{key}"):
        _control.TeamController(parameters.controller, without(parameters.team, (key,)))
