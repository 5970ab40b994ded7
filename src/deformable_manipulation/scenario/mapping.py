"""Scenarios as plain values: what the resolved YAML and the parameter server hold."""

import dataclasses
from typing import Any, Dict

import yaml

from deformable_manipulation.reading.readers import Section
from deformable_manipulation.scenario.spec import (
    AgentSpec,
    FabricSpec,
    PolygonObstacle,
    RodSpec,
    Scenario,
)


def scenario_to_mapping(scenario: Scenario) -> Dict[str, Any]:
    """The scenario as dicts, lists, strings, numbers and flags, with nothing left to look up.

    Defaults are filled in; polygons and fabrics are inline, mesh obstacles named by their absolute
    paths; distances that are found from the object are ``auto``.
    :func:`~deformable_manipulation.scenario.loader.scenario_from_mapping` makes an equal scenario
    of it. It suits the parameter server: no empty values, no large integers.
    """
    mapping = _plain(scenario)
    mapping["object"] = _object(scenario.object)
    mapping["agents"] = {agent.name: _agent(agent) for agent in scenario.agents}
    if not isinstance(scenario.object, RodSpec):
        del mapping["simulation"]["solver"]
    mapping["obstacles"] = [_obstacle(obstacle) for obstacle in scenario.obstacles]
    return mapping


def controller_to_mapping(scenario: Scenario) -> Dict[str, Any]:
    """The section ``controller`` of :func:`scenario_to_mapping`."""
    return _plain(scenario.controller)


def scenario_to_yaml(scenario: Scenario) -> str:
    """The mapping of :func:`scenario_to_mapping` as YAML text."""
    return yaml.safe_dump(scenario_to_mapping(scenario), sort_keys=False, default_flow_style=None)


def _agent(agent: AgentSpec) -> Dict[str, Any]:
    mapping = _plain(agent)
    del mapping["name"]
    return mapping


def _object(spec) -> Dict[str, Any]:
    mapping = _plain(spec)
    if isinstance(spec, FabricSpec):
        mesh = {key: mapping.pop(key) for key in ("vertices", "triangles")}
        mapping = {"mesh": mesh, **mapping}
    return {"type": spec.type, **mapping}


def _obstacle(obstacle) -> Dict[str, Any]:
    mapping = _plain(obstacle)
    if obstacle.motion is None:
        del mapping["motion"]
    if isinstance(obstacle, PolygonObstacle):
        mapping = {"name": mapping.pop("name"), "polygon": mapping.pop("points"), **mapping}
    return mapping


def _plain(value):
    if dataclasses.is_dataclass(value):
        return {
            field.name: _plain(getattr(value, field.name))
            for field in dataclasses.fields(value)
            if not _is_absent(field, getattr(value, field.name))
        }
    if isinstance(value, tuple):
        return [_plain(item) for item in value]
    return "auto" if value is None else value


def _is_absent(field: dataclasses.Field, value) -> bool:
    """Whether a section is not in use."""
    declaration = field.metadata.get("parameter")
    return value is None and declaration is not None and isinstance(declaration.reader, Section)
