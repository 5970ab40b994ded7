"""What the two barriers on the distances between agents share."""

from dataclasses import dataclass
from itertools import combinations

import numpy as np

AUTO_MIN_DISTANCE = 0.10  # of the free length


@dataclass(frozen=True)
class PairLimits:
    """Allowed distance between the held points of two agents (paper, eqs. 8 and 11)."""

    max_distance: float  # m
    min_distance: float  # m


def limits_between(spec, first, second, controller) -> PairLimits:
    """Limits of the distance between two agents.

    Args:
        spec: the object that they hold.
        first: one agent.
        second: the other one.
        controller: the section ``controller``.
    """
    length = spec.free_length(first.particle, second.particle)
    max_distance = controller.overstretch.max_distance
    min_distance = controller.proximity.min_distance
    return PairLimits(
        controller.overstretch.fraction * length if max_distance is None else max_distance,
        AUTO_MIN_DISTANCE * length if min_distance is None else min_distance,
    )


def limit_matrix(spec, agents, controller, name: str) -> np.ndarray:
    """A limit between any two agents.

    Args:
        spec: the object that they hold.
        agents: the A agents.
        controller: the section ``controller``.
        name: of the limit in :class:`PairLimits`.

    Returns:
        (A, A) [m], symmetric, with zeros on the diagonal.
    """
    limits = np.zeros((len(agents), len(agents)))
    for i, j in combinations(range(len(agents)), 2):
        pair = limits_between(spec, agents[i], agents[j], controller)
        limits[i, j] = limits[j, i] = getattr(pair, name)
    return limits
