"""Limits that follow from the whole scenario where they are ``auto``."""

from dataclasses import dataclass
from typing import Tuple

from deformable_manipulation.geometry.pose import Vector
from deformable_manipulation.scenario.spec import AgentSpec, ControllerSpec, Scenario

AUTO_MIN_DISTANCE = 0.10  # of the free length
AUTO_WORKSPACE = 0.5  # m around the leader's path


@dataclass(frozen=True)
class PairLimits:
    """Allowed distance between the held points of two agents (paper, eqs. 8 and 11)."""

    max_distance: float  # m
    min_distance: float  # m


def pair_limits(scenario: Scenario, i: int, j: int) -> PairLimits:
    """Limits of the distance between agents ``i`` and ``j`` (indices in ``scenario.agents``)."""
    agents = scenario.agents
    return limits_between(scenario.object, agents[i], agents[j], scenario.controller)


def limits_between(
    spec, first: AgentSpec, second: AgentSpec, controller: ControllerSpec
) -> PairLimits:
    """Limits of the distance between two agents that hold the object ``spec``."""
    length = spec.free_length(first.particle, second.particle)
    max_distance = controller.overstretch.max_distance
    min_distance = controller.proximity.min_distance
    return PairLimits(
        controller.overstretch.fraction * length if max_distance is None else max_distance,
        AUTO_MIN_DISTANCE * length if min_distance is None else min_distance,
    )


def leader_workspace(scenario: Scenario) -> Tuple[Vector, Vector]:
    """Lower and upper corner [m] of the box in which the leader can be moved by hand."""
    box = scenario.leader.workspace
    if box is not None:
        return box.lower, box.upper
    start = scenario.agents[scenario.leader_index].start
    axes = list(zip(*(waypoint.position for waypoint in scenario.leader.waypoints)))
    lower = tuple(s + min(axis) - AUTO_WORKSPACE for s, axis in zip(start, axes))
    upper = tuple(s + max(axis) + AUTO_WORKSPACE for s, axis in zip(start, axes))
    return lower, upper
