"""What an assistant's controller sees of one state."""

import math
import numbers
from dataclasses import dataclass
from typing import Optional

import numpy as np

from deformable_manipulation.distance.features import Distances


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
    # (A, P, 3, 3) d point / d held point of the object at rest; None: not known
    sensitivities: Optional[np.ndarray] = None


def find_fault(observation, agents):
    """What makes an observation unusable.

    Args:
        observation: the :class:`Observation` to check.
        agents: number of agents A that it must have.

    Returns:
        A sentence that names the field, or an empty string for a sound observation.
    """
    return (
        _wrong_type(observation)
        or _wrong_shape(observation, agents)
        or _not_finite(observation)
        or _wrong_index(observation, agents)
    )


# Kinds of numpy's numbers.
_NUMBERS, _WHOLE_NUMBERS, _FLAGS = "fiu", "iu", "b"


def _wrong_type(observation):
    if not isinstance(observation, Observation):
        return f"it got {type(observation).__name__}, not an Observation"
    if not isinstance(observation.time, numbers.Real):
        return f"time of the state is {type(observation.time).__name__}, expected a number"
    distances = observation.distances
    if not isinstance(distances, Distances):
        return f"distances of the state is {type(distances).__name__}, expected Distances"
    wanted = (
        ("positions", observation.positions, _NUMBERS),
        ("points", observation.points, _NUMBERS),
        ("displaced_agents", observation.displaced_agents, _WHOLE_NUMBERS),
        ("displacements", observation.displacements, _NUMBERS),
        ("ready", observation.ready, _FLAGS),
        ("distances.minimum", distances.minimum, _NUMBERS),
        ("distances.offsets", distances.offsets, _WHOLE_NUMBERS),
        ("distances.distance", distances.distance, _NUMBERS),
        ("distances.normal", distances.normal, _NUMBERS),
        ("distances.vertices", distances.vertices, _WHOLE_NUMBERS),
        ("distances.weights", distances.weights, _NUMBERS),
        ("distances.obstacle_velocity", distances.obstacle_velocity, _NUMBERS),
    )
    for name, value, kinds in wanted:
        if not isinstance(value, np.ndarray):
            return f"{name} of the state is {type(value).__name__}, expected an array"
        if value.dtype.kind not in kinds:
            return f"{name} of the state is an array of {value.dtype}"
    return ""


def _wrong_shape(observation, agents):
    if np.ndim(observation.points) != 3 or not len(observation.points):
        return f"points of the state has shape {np.shape(observation.points)}, expected (C, P, 3)"
    copies, points = np.shape(observation.points)[:2]
    features = np.shape(observation.distances.distance)
    wanted = (
        ("positions", observation.positions, (agents, 3)),
        ("points", observation.points, (copies, points, 3)),
        ("displaced_agents", observation.displaced_agents, (copies,)),
        ("displacements", observation.displacements, (copies, 3)),
        ("ready", observation.ready, (copies,)),
        ("distances.minimum", observation.distances.minimum, (copies,)),
        ("distances.offsets", observation.distances.offsets, (copies + 1,)),
        ("distances.normal", observation.distances.normal, features + (3,)),
        ("distances.weights", observation.distances.weights, features + (3,)),
        ("distances.vertices", observation.distances.vertices, features + (3,)),
        ("distances.obstacle_velocity", observation.distances.obstacle_velocity, features + (3,)),
    )
    if observation.sensitivities is not None:
        wanted += (("sensitivities", observation.sensitivities, (agents, points, 3, 3)),)
    for name, value, shape in wanted:
        if np.shape(value) != shape:
            return f"{name} of the state has shape {np.shape(value)}, expected {shape}"
    return ""


def _not_finite(observation):
    if not math.isfinite(observation.time):
        return f"time of the state is {observation.time}, not a finite number"
    distances = observation.distances
    fields = (
        ("positions", observation.positions),
        ("points", observation.points),
        ("displacements", observation.displacements),
        ("distances.distance", distances.distance),
        ("distances.normal", distances.normal),
        ("distances.weights", distances.weights),
        ("distances.obstacle_velocity", distances.obstacle_velocity),
    )
    if observation.sensitivities is not None:
        fields += (("sensitivities", observation.sensitivities),)
    for name, value in fields:
        if not np.isfinite(value).all():
            return f"{name} of the state holds a number that is not finite"
    # A minimum is infinite, and only then, where a copy has no feature.
    without_feature = np.diff(distances.offsets) == 0
    if not (np.isfinite(distances.minimum) | without_feature).all() or np.isnan(
        distances.minimum
    ).any():
        return "distances.minimum of the state holds a number that is not finite"
    return ""


def _wrong_index(observation, agents):
    distances = observation.distances
    offsets = distances.offsets
    if offsets[0] != 0 or offsets[-1] != len(distances.distance) or (np.diff(offsets) < 0).any():
        return f"distances.offsets of the state do not cover its {len(distances.distance)} features"
    vertices, points = distances.vertices, observation.points.shape[1]
    if vertices.size and (vertices.min() < 0 or vertices.max() >= points):
        return f"distances.vertices of the state are outside 0 .. {points - 1}"
    displaced = observation.displaced_agents
    if displaced.min() < -1 or displaced.max() >= agents:
        return f"displaced_agents of the state are outside -1 .. {agents - 1}"
    return ""
