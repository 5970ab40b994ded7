"""The native controller's parameters from a scenario."""

from typing import Any, Dict, NamedTuple, Sequence

import numpy as np

from deformable_manipulation.scenario.barriers import BARRIERS
from deformable_manipulation.scenario.controller import COORDINATED
from deformable_manipulation.scenario.mapping import controller_to_mapping
from deformable_manipulation.scenario.spec import Scenario


class NativeParameters(NamedTuple):
    """Parameters of ``_control.TeamController``.

    Attributes:
        controller: the scenario's section, with what the barriers derive from the object.
        team: all agents, whose velocities are decided together, and which of these it commands.
    """

    controller: Dict[str, Any]
    team: Dict[str, Any]


def native_parameters(scenario: Scenario, names: Sequence[str], safety: bool) -> NativeParameters:
    """The parameters of a controller.

    Args:
        scenario: the checked scenario.
        names: of the assistants that it commands.
        safety: False leaves the barriers out.

    Raises:
        ValueError: the scenario has no assistant of that name.
    """
    own, leader = [_index_of(scenario, name) for name in names], scenario.leader_index
    coordinated = scenario.controller.cooperation == COORDINATED
    commanded = list(scenario.assistants) if coordinated else own
    starts = np.array([each.start for each in scenario.agents], dtype=float)
    team = {
        "agents": len(scenario.agents),
        "leader": leader,
        "assistants": list(scenario.assistants),
        "commanded": commanded,
        "own": [commanded.index(index) for index in own],
        "references": starts[commanded] - starts[leader],
        "places": starts - starts[leader],
        "orientations": [list(agent.orientation) for agent in scenario.agents],
        "cycle_time": scenario.cycle_time,
        "safety": safety,
        "barriers": list(scenario.controller.barriers),
    }
    return NativeParameters(_controller(scenario), team)


def _controller(scenario: Scenario) -> Dict[str, Any]:
    mapping = controller_to_mapping(scenario)
    mapping["priority"] = list(scenario.controller.priority or scenario.controller.barriers)
    for name in scenario.controller.barriers:
        mapping[name].update(BARRIERS[name].derive(scenario))
    return mapping


def _index_of(scenario: Scenario, name: str) -> int:
    assistants = {scenario.agents[i].name: i for i in scenario.assistants}
    if name not in assistants:
        raise ValueError(
            f"agent: '{name}' must be one of the scenario's assistants: {', '.join(assistants)}"
        )
    return assistants[name]
