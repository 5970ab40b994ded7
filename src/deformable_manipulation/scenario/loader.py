"""Scenarios from files and mappings: every mistake is found in one pass."""

import dataclasses
from pathlib import Path
from typing import Any, Dict, Iterable, Mapping, Union

from deformable_manipulation.obstacles.motions import check_frames
from deformable_manipulation.reading.document import read_document
from deformable_manipulation.reading.errors import ScenarioError
from deformable_manipulation.reading.overrides import Override, apply_overrides
from deformable_manipulation.reading.readers import (
    Node,
    Report,
    Section,
    Unreadable,
)
from deformable_manipulation.scenario import checks, controller, knowledge, simulation
from deformable_manipulation.scenario.agents import read_agents
from deformable_manipulation.scenario.camera import (
    check_camera,
    check_knowledge,
    check_live_obstacles,
    check_presence,
)
from deformable_manipulation.scenario.correction import check_correction, check_measured_points
from deformable_manipulation.scenario.files import find_scenario
from deformable_manipulation.scenario.formulation import CONTROLLER, check_formulation
from deformable_manipulation.scenario.orientation import check_orientation, check_turning_leader
from deformable_manipulation.scenario.spec import Scenario
from deformable_manipulation.scenario.world import check_world

SCENARIO = Section(Scenario, defaults={"obstacles": ()})


def load_scenario(path_or_name: Union[str, Path], overrides: Iterable[Override] = ()) -> Scenario:
    """Read and check a scenario.

    Args:
        path_or_name: a YAML file, or the bare name of a scenario in ``config/scenarios``.
        overrides: (key path, value as YAML text) pairs that replace values of the file, list
            items by index: ``("leader.waypoints.1.time", "3")``.

    Raises:
        ScenarioError: with all problems found.
    """
    overrides = tuple(overrides)
    path = find_scenario(str(path_or_name))
    document = read_document(path)
    raw, lines, problems = apply_overrides(document.value, document.lines, overrides)
    report = Report(lines, [tuple(key.split(".")) for key, _ in overrides])
    report.problems.extend(document.problems)
    report.problems.extend(problems)
    root = Node(raw, (), report, path.resolve().parent)
    return _read_scenario(root, path.stem, str(path))


def scenario_from_mapping(
    mapping: Mapping[str, Any],
    directory: Union[str, Path],
    default_name: str = "scenario",
    files_are_read: bool = False,
) -> Scenario:
    """Check a scenario given as plain values, such as the ``scenario`` parameter of a node.

    Args:
        mapping: what the YAML file would hold.
        directory: where relative file names start.
        default_name: name of a scenario that has none of its own.
        files_are_read: the mapping is a checked one (:func:`scenario_to_mapping`); the files
            that it names are not read once more.

    Raises:
        ScenarioError: with all problems found.
    """
    root = Node(mapping, (), Report(), Path(directory), files_are_read)
    return _read_scenario(root, default_name, "")


def with_controller(scenario: Scenario, section: Mapping[str, Any]) -> Scenario:
    """A scenario with another section ``controller``, checked as the whole would be.

    Args:
        section: as :func:`~deformable_manipulation.scenario.mapping.controller_to_mapping` gives
            it: with every key that depends on the object.

    Raises:
        ScenarioError: with all problems found.
    """
    parts = {field.name: getattr(scenario, field.name) for field in dataclasses.fields(scenario)}
    report = Report()
    node = Node(section, ("controller",), report, Path("."))
    try:
        parts["controller"] = CONTROLLER(node)
    except Unreadable:
        del parts["controller"]
    _check_together(report, parts)
    if report.problems:
        raise ScenarioError(report.problems)
    return Scenario(**parts)


def _read_scenario(root: Node, default_name: str, source: str) -> Scenario:
    parts: Dict[str, Any] = {}
    try:
        parts = _read_sections(root, default_name)
    except Unreadable:
        pass  # reported
    _check_together(root.report, parts)
    if root.report.problems:
        raise ScenarioError(root.report.problems, source)
    return Scenario(**parts)


def _read_sections(root: Node, default_name: str) -> Dict[str, Any]:
    """The parts of a Scenario that can be read; raises Unreadable for no mapping at all."""
    if isinstance(root.value, dict):
        named = {"name": default_name, **root.value}
        root = dataclasses.replace(root, value=named)
    parts = SCENARIO.read_parts(root)
    if "agents" in parts:
        try:
            parts["agents"], parts["object"] = read_agents(parts["agents"], parts.get("object"))
        except Unreadable:
            del parts["agents"]
    if "object" in parts:
        _fill_in(root.report, parts)
    return parts


def _fill_in(report: Report, parts: Dict[str, Any]) -> None:
    """What the sections leave to the object."""
    if "simulation" in parts:
        parts["simulation"] = simulation.for_object(report, parts["simulation"], parts["object"])
    if "controller" in parts:
        parts["controller"] = controller.for_object(parts["controller"], parts["object"])
    if "knowledge" in parts:
        parts["knowledge"] = knowledge.for_object(report, parts["knowledge"], parts["object"])


def _check_together(report: Report, parts: Dict[str, Any]) -> None:
    """Check sections against each other, as far as they could be read."""

    def check(function, *keys):
        if all(key in parts for key in keys):
            function(report, *(parts[key] for key in keys))

    check(check_frames, "frame", "obstacles")
    check(checks.check_loop, "controller")
    check(controller.check_priority, "controller")
    check(check_orientation, "object", "agents", "controller", "knowledge")
    check(check_turning_leader, "leader", "controller", "knowledge")
    check(check_formulation, "controller")
    check(checks.check_time, "controller", "simulation")
    check(knowledge.check_delay, "controller", "knowledge")
    check(knowledge.check_loads, "controller", "knowledge")
    check(check_world, "object", "knowledge")
    check(check_correction, "object", "correction")
    check(check_measured_points, "knowledge", "correction")
    check(check_camera, "frame", "obstacles", "controller", "camera")
    check(check_live_obstacles, "obstacles", "controller")
    check(check_presence, "obstacles")
    check(check_knowledge, "obstacles", "knowledge")
    check(checks.check_starts, "object", "agents")
    check(checks.check_workspace, "agents", "leader")
    check(checks.check_limits, "object", "agents", "controller")
    check(checks.check_barriers, "object", "agents", "controller")
    check(checks.check_perturbation, "object", "agents", "controller")
