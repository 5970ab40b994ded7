"""What an assistant's controller decided in one cycle, and why."""

from dataclasses import dataclass, field
from typing import Mapping

import numpy as np

from deformable_manipulation.control.status import DetourState, Status


def _unknown_vector():
    return np.full(3, np.nan)


def _no_turning():
    return np.zeros(3)


@dataclass(frozen=True)
class Decision:
    """One cycle of an assistant's controller; what ControllerState.msg tells.

    The command is always finite. Everything else is NaN if it is not known, for example
    while waiting for valid input.
    """

    status: Status
    text: str  # the status in a sentence
    enabled: bool
    command: np.ndarray  # (3,) m/s, of the own held point
    nominal: np.ndarray = field(default_factory=_unknown_vector)  # (3,) m/s
    # (3,) rad/s, of the own grip, and what it would be without limits; nan: grips do not turn
    angular_command: np.ndarray = field(default_factory=_no_turning)
    angular_nominal: np.ndarray = field(default_factory=_unknown_vector)
    # (3,) rad, rotation vector from the present to the wanted orientation; nan likewise
    orientation_error: np.ndarray = field(default_factory=_unknown_vector)
    position: np.ndarray = field(default_factory=_unknown_vector)  # (3,) m, own held point
    target: np.ndarray = field(default_factory=_unknown_vector)  # (3,) m, leader plus reference
    error: np.ndarray = field(default_factory=_unknown_vector)  # (3,) m, target minus position
    distance: float = np.nan  # m, signed minimum of the object; inf: no obstacle
    h: Mapping[str, float] = field(default_factory=dict)  # the lowest of each barrier, by name
    jacobian: np.ndarray = field(default_factory=_unknown_vector)  # (3,) 1, d distance / d position
    exact_jacobian: bool = False  # from the equilibrium; False: from perturbed copies
    coordinated: bool = False  # decided together with all assistants; False: by shares
    detour: DetourState = DetourState.NONE
    leader_drift: float = np.nan  # m/s, change of the distance by the leader's motion
    rows: int = 0  # of the barriers
    # m/s, how far the rows of each barrier are relaxed at most, by name
    slack: Mapping[str, float] = field(default_factory=dict)
    solve_time: float = 0.0  # s, safety filter alone
    computation_time: float = 0.0  # s, whole update
    reason: str = ""  # why it waits, as a clause; empty: it does not

    @property
    def error_norm(self):
        """Distance from the target [m]."""
        return float(np.sqrt(self.error @ self.error))
