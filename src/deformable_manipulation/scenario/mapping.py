"""Scenarios as plain values: what the resolved YAML and the parameter server hold."""

from typing import Any, Dict

import yaml

from deformable_manipulation.reading.plain import plain
from deformable_manipulation.scenario.spec import AgentSpec, Scenario


def scenario_to_mapping(scenario: Scenario) -> Dict[str, Any]:
    """The scenario as dicts, lists, strings, numbers and flags, with nothing left to look up.

    Defaults are filled in; polygons and fabrics are inline, mesh obstacles named by their absolute
    paths; distances that are found from the object are ``auto``.
    :func:`~deformable_manipulation.scenario.loader.scenario_from_mapping` makes an equal scenario
    of it. It suits the parameter server: no empty values, no large integers.
    """
    mapping = plain(scenario)
    mapping["object"] = scenario.object.to_mapping()
    mapping["agents"] = {agent.name: _agent(agent) for agent in scenario.agents}
    if not scenario.object.has_joints:
        del mapping["simulation"]["solver"]
    mapping["obstacles"] = [obstacle.to_mapping() for obstacle in scenario.obstacles]
    return mapping


def controller_to_mapping(scenario: Scenario) -> Dict[str, Any]:
    """The section ``controller`` of :func:`scenario_to_mapping`."""
    return plain(scenario.controller)


def scenario_to_yaml(scenario: Scenario) -> str:
    """The mapping of :func:`scenario_to_mapping` as YAML text."""
    return yaml.safe_dump(scenario_to_mapping(scenario), sort_keys=False, default_flow_style=None)


def _agent(agent: AgentSpec) -> Dict[str, Any]:
    mapping = plain(agent)
    del mapping["name"]
    return mapping
