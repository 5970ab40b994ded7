"""What an assistant's controller sees of one state."""

import dataclasses
from dataclasses import dataclass
from typing import Any, Mapping, Optional

import numpy as np

from deformable_manipulation import _control
from deformable_manipulation.distance.features import Distances
from deformable_manipulation.motion.intent import Intent


@dataclass(frozen=True)
class Observation:
    """One state with its distances: A agents, C copies of the object with P points each.

    Copy 0 is the object itself. Everything is in the fixed frame and belongs to one time.
    """

    time: float  # s, of the state
    cycle: int
    positions: np.ndarray  # (A, 3) m, held points, in the scenario's order
    points: np.ndarray  # (C, P, 3) m, geometry points of each copy
    displaced_agents: np.ndarray  # (C,) int, whose held point is displaced; -1: none
    displacements: np.ndarray  # (C, 3) m, present displacement of that held point
    ready: np.ndarray  # (C,) bool, false while a copy still moves to its displacement
    distances: Distances  # of all C copies
    # (A, 3) m/s, of the held points; None: to be found from the positions
    velocities: Optional[np.ndarray] = None
    orientations: Optional[np.ndarray] = None  # (A, 4) x, y, z, w of the grips; None: not told
    # (A, 3) rad/s, of the grips; None: to be found from the orientations
    angular_velocities: Optional[np.ndarray] = None
    # (A, P, 3, 3) d point / d held point of the object at rest; None: not known
    sensitivities: Optional[np.ndarray] = None
    # (A, P, 3, 3) m/rad, d point / d turn about the held point, at rest; None: not known
    turning_sensitivities: Optional[np.ndarray] = None
    # (C, A, 6) N and N m about the held point, that each copy exerts on the agents; None: not told
    wrenches: Optional[np.ndarray] = None
    # (A, 6, A, 6) d wrench / d held point, turn, of the object at rest; None: not known
    wrench_sensitivities: Optional[np.ndarray] = None
    # (P, 3) m, how measured points have moved those of the model; None: not
    correction: Optional[np.ndarray] = None
    obstacles: Optional[np.ndarray] = None  # (K, 7) poses of those that move: m, x, y, z, w
    # What is seen of live obstacles, by their indices (seeing.live_map.Seen)
    seen: Mapping[int, Any] = dataclasses.field(default_factory=dict)
    intent: Optional[Intent] = None  # where the leader will be; None: it announces nothing
    lateness: float = 0.0  # s, delay beyond one cycle until commands that answer it act


def find_fault(observation, agents):
    """What makes an observation unusable.

    Args:
        observation: the :class:`Observation` to check.
        agents: number of agents A that it must have.

    Returns:
        A clause that names the field, or an empty string for a sound observation.
    """
    return wrong_type(observation) or _control.find_fault(observation, agents)


def wrong_type(observation):
    """A clause if it is no Observation; the C++ core checks what is in it."""
    if not isinstance(observation, Observation):
        return f"it got {type(observation).__name__}, not an Observation"
    return ""
