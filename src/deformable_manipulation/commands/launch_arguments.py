"""What launch files hand to ``check_scenario``: their own arguments, checked with the scenario."""

import argparse
import os
import re
from typing import Iterator, Optional, Sequence

from deformable_manipulation.commands.arguments import overrides
from deformable_manipulation.reading.errors import Problem
from deformable_manipulation.reading.readers import nearest
from deformable_manipulation.scenario.spec import (
    CENTRALISED,
    DECENTRALISED,
    Scenario,
    TopicMotion,
)

LEADER_INPUTS = ("waypoints", "hand")
_BOOLS = ("true", "false")
# Of a group in a launch file: a graph resource name of ROS.
_NAMESPACE = re.compile(r"/?|/?[A-Za-z]\w*(?:/+[A-Za-z]\w*)*/?", re.ASCII)


def add_launch_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of launch files, each as one text."""
    group = parser.add_argument_group(
        "for launch files", "check the arguments of a launch before any node starts"
    )
    group.add_argument(
        "--sets",
        metavar="'KEY.PATH=VALUE ...'",
        type=overrides,
        default=[],
        help="several values to replace, separated by blanks",
    )
    group.add_argument(
        "--assistants",
        metavar="NAMES",
        type=str.split,
        help="assistants that must be in the scenario, separated by blanks",
    )
    group.add_argument(
        "--all-assistants",
        action="store_true",
        help="--assistants must name all assistants: a lock-step run waits for each of them",
    )
    group.add_argument(
        "--one-process",
        metavar="BOOL",
        help="false: each controller in its own process; none: on its own computer",
    )
    group.add_argument("--leader-input", metavar="INPUT", help=" or ".join(LEADER_INPUTS))
    group.add_argument(
        "--drag-obstacles",
        metavar="BOOL",
        help="true: at least one obstacle must have motion.topic",
    )
    group.add_argument("--camera", metavar="BOOL", help="true: the scenario must have a camera")
    group.add_argument("--leader", metavar="NAME", help="name of the scenario's leader")
    group.add_argument(
        "--last-word",
        action="store_true",
        help="list mistakes after the program that started this one, roslaunch, has ended",
    )
    group.add_argument("--namespace", metavar="NAME", help="of the run: a legal ROS name")
    group.add_argument("--output", metavar="DIR", help="writable folder for a recording")


def launch_problems(arguments: argparse.Namespace, scenario: Scenario) -> Iterator[Problem]:
    """What is wrong with a launch's arguments for a correct scenario."""
    if arguments.assistants is not None:
        yield from _assistant_problems(arguments, scenario)
        yield from _knowledge_problems(scenario)
    yield from _choice_problems(arguments)
    yield from _namespace_problems(arguments.namespace)
    yield from _cooperation_problems(arguments, scenario)
    yield from _drag_problems(arguments, scenario)
    yield from _camera_problems(arguments, scenario)
    leader = scenario.agents[scenario.leader_index].name
    if arguments.leader not in (None, leader):
        yield Problem(
            "leader",
            f"is not the scenario's leader; use leader:={leader}",
            f"'{arguments.leader}'",
        )
    if arguments.output is not None:
        yield from _folder_problems(arguments.output)


def _choice_problems(arguments: argparse.Namespace) -> Iterator[Problem]:
    for name, given, allowed in (
        ("one_process", arguments.one_process, (*_BOOLS, "none")),
        ("leader_input", arguments.leader_input, LEADER_INPUTS),
        ("drag_obstacles", arguments.drag_obstacles, _BOOLS),
        ("camera", arguments.camera, _BOOLS),
    ):
        if given is not None and given.lower() not in allowed:
            yield Problem(name, "allowed: {} or {}".format(*allowed[:2]), f"'{given}'")


def _namespace_problems(namespace: Optional[str]) -> Iterator[Problem]:
    if namespace is not None and not _NAMESPACE.fullmatch(namespace):
        yield Problem(
            "namespace",
            "allowed: names of letters, digits and _ that start with a letter, separated by /",
            f"'{namespace}'",
        )


def _drag_problems(arguments: argparse.Namespace, scenario: Scenario) -> Iterator[Problem]:
    moved = any(isinstance(obstacle.motion, TopicMotion) for obstacle in scenario.obstacles)
    if arguments.drag_obstacles == "true" and not moved:
        yield Problem(
            "drag_obstacles",
            "no obstacle has motion.topic, so none can be dragged; set one, as in "
            "set:='obstacles.0.motion={topic: block}'",
            "'true'",
        )


def _camera_problems(arguments: argparse.Namespace, scenario: Scenario) -> Iterator[Problem]:
    if arguments.camera == "true" and scenario.camera is None:
        yield Problem(
            "camera", "the scenario has no section camera, so none can be simulated", "'true'"
        )


def _assistant_problems(arguments: argparse.Namespace, scenario: Scenario) -> Iterator[Problem]:
    given: Sequence[str] = arguments.assistants
    known = [scenario.agents[index].name for index in scenario.assistants]
    for name in given:
        if name not in known:
            yield Problem(
                "assistants",
                "is not an assistant of the scenario;{} assistants: {}".format(
                    nearest(name, known), ", ".join(known)
                ),
                f"'{name}'",
            )
    if len(set(given)) < len(given):
        yield Problem("assistants", "contains a name twice", f"'{' '.join(given)}'")
    absent = [name for name in known if name not in given]
    if arguments.all_assistants and absent:
        yield Problem(
            "assistants",
            'lacks {}, but a lock-step run waits for every assistant; use assistants:="{}"'.format(
                ", ".join(absent), " ".join(known)
            ),
            f"'{' '.join(given)}'",
        )


def _cooperation_problems(arguments: argparse.Namespace, scenario: Scenario) -> Iterator[Problem]:
    if scenario.controller.cooperation != CENTRALISED:
        return
    if arguments.one_process in ("false", "none"):
        yield Problem(
            "controller.cooperation",
            "then one process decides for all assistants; do not use one_process:=false or "
            f"agent.launch, or change it to {DECENTRALISED}",
            f"'{CENTRALISED}'",
        )
    elif arguments.assistants:
        known = [scenario.agents[index].name for index in scenario.assistants]
        if set(known) - set(arguments.assistants):
            yield Problem(
                "assistants",
                'must be all of a centralised scenario, or none; use assistants:="{}"'.format(
                    " ".join(known)
                ),
                f"'{' '.join(arguments.assistants)}'",
            )


def _knowledge_problems(scenario: Scenario) -> Iterator[Problem]:
    if not scenario.knowledge.perfect:
        yield Problem(
            "knowledge",
            "applies only to runs without ROS (run_scenario, run_campaign); remove the section",
        )


def _folder_problems(folder: str) -> Iterator[Problem]:
    if not os.path.exists(folder):
        yield Problem("output", "does not exist; create the folder, or name another", f"'{folder}'")
    elif not os.path.isdir(folder):
        yield Problem("output", "is not a folder; name a folder", f"'{folder}'")
    elif not os.access(folder, os.W_OK | os.X_OK):
        yield Problem("output", "is not writable; name another folder", f"'{folder}'")
