"""Where the leader will be, as it announces that."""

from dataclasses import dataclass

import numpy as np

from deformable_manipulation import _control
from deformable_manipulation.scenario.spec import Scenario


@dataclass(frozen=True)
class Intent:
    """An announcement: the leader's held point at K times, straight in between.

    Raises:
        ValueError: of a wrong shape, fewer than two times, a number that is not finite, times that
            do not increase, or a leap; the message is a clause.
    """

    times: np.ndarray  # (K,) s, by the clock of the observations
    positions: np.ndarray  # (K, 3) m, in the fixed frame

    def __post_init__(self):
        fault = _control.find_intent_fault(self.times, self.positions)
        if fault:
            raise ValueError(fault)


def leader_announces(scenario: Scenario) -> bool:
    """Whether the package's leader announces its path: one that follows poses is led by others."""
    leader = scenario.agents[scenario.leader_index]
    return scenario.controller.horizon.announced and leader.driven_by != "pose"


def times_ahead(scenario: Scenario) -> np.ndarray:
    """Times (K,) [s] from a state to those at which its leader announces where it will be.

    They reach beyond the horizon by what an announcement may be old. There are two in each interval
    of the horizon.
    """
    horizon = scenario.controller.horizon
    reach = horizon.length + scenario.controller.timeout
    return np.linspace(0.0, reach, 2 * horizon.nodes + 1)
