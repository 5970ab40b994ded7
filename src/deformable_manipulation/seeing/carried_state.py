"""Where the object and the agents were when something was seen."""

from collections import deque
from typing import Deque, NamedTuple, Optional

import numpy as np

_MOST_STATES = 200  # two seconds of 100 Hz


class CarriedState(NamedTuple):
    """The modelled object and the agents at a time: A agents, P points."""

    time: float  # s
    points: np.ndarray  # (P, 3) m, geometry points of the object itself
    positions: np.ndarray  # (A, 3) m, held points, in the scenario's order
    orientations: np.ndarray  # (A, 4) quaternions x, y, z, w


class StateHistory:
    """The states of the last seconds, for data that come late."""

    def __init__(self):
        self._states: Deque[CarriedState] = deque(maxlen=_MOST_STATES)

    def add(self, state: CarriedState) -> None:
        """Take in a state; one that is older than the last means that time was set back."""
        if self._states and state.time < self._states[-1].time:
            self._states.clear()
        self._states.append(state)

    def at(self, time: float) -> Optional[CarriedState]:
        """The state that is nearest to a time [s]; None: there is none yet."""
        states = tuple(self._states)  # others may add one meanwhile
        return min(states, key=lambda state: abs(state.time - time)) if states else None
