"""Limits of the distance between two agents (paper, eqs. 8 and 11)."""

from dataclasses import dataclass

from deformable_manipulation.scenario.objects import free_length
from deformable_manipulation.scenario.spec import AgentSpec, ControllerSpec, Scenario

AUTO_MIN_DISTANCE = 0.10  # of the free length


@dataclass(frozen=True)
class PairLimits:
    """Allowed distance between the held points of two agents."""

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
    length = free_length(spec, first.particle, second.particle)
    max_distance = controller.overstretch.max_distance
    min_distance = controller.proximity.min_distance
    return PairLimits(
        controller.overstretch.fraction * length if max_distance is None else max_distance,
        AUTO_MIN_DISTANCE * length if min_distance is None else min_distance,
    )
