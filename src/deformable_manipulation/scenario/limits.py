"""Limits that follow from the whole scenario where they are ``auto``."""

from typing import Tuple

from deformable_manipulation.scenario.barriers.pairs import PairLimits, limits_between
from deformable_manipulation.scenario.spec import Scenario, Vector

AUTO_WORKSPACE = 0.5  # m around the leader's path


def pair_limits(scenario: Scenario, i: int, j: int) -> PairLimits:
    """Limits of the distance between agents ``i`` and ``j`` (indices in ``scenario.agents``)."""
    agents = scenario.agents
    return limits_between(scenario.object, agents[i], agents[j], scenario.controller)


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
