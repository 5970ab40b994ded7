"""Scenarios as plain values: what the resolved YAML and the parameter server hold."""

import dataclasses
from typing import Any, Dict

import yaml

from deformable_manipulation.scenario.spec import AgentSpec, PolygonObstacle, Scenario


def scenario_to_mapping(scenario: Scenario) -> Dict[str, Any]:
    """The scenario as dicts, lists, strings, numbers and flags, with nothing left to look up.

    Defaults are filled in, polygons are inline, distances that are found from the object are
    ``auto``. :func:`~deformable_manipulation.scenario.loader.scenario_from_mapping` makes an equal
    scenario of it. It suits the parameter server: no empty values, no large integers.
    """
    mapping = _plain(scenario)
    mapping["object"] = {"type": scenario.object.type, **mapping["object"]}
    mapping["agents"] = {agent.name: _agent(agent) for agent in scenario.agents}
    mapping["obstacles"] = [_obstacle(obstacle) for obstacle in scenario.obstacles]
    return mapping


def scenario_to_yaml(scenario: Scenario) -> str:
    """The mapping of :func:`scenario_to_mapping` as YAML text."""
    return yaml.safe_dump(scenario_to_mapping(scenario), sort_keys=False, default_flow_style=None)


def _agent(agent: AgentSpec) -> Dict[str, Any]:
    mapping = _plain(agent)
    del mapping["name"]
    return mapping


def _obstacle(obstacle: PolygonObstacle) -> Dict[str, Any]:
    mapping = _plain(obstacle)
    return {"name": mapping.pop("name"), "polygon": mapping.pop("points"), **mapping}


def _plain(value):
    if dataclasses.is_dataclass(value):
        return {f.name: _plain(getattr(value, f.name)) for f in dataclasses.fields(value)}
    if isinstance(value, tuple):
        return [_plain(item) for item in value]
    return "auto" if value is None else value
