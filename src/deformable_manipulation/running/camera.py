"""A camera that sees points of the true object: late, with noise, and not all of it."""

import math
from collections import deque
from typing import Deque, NamedTuple, Optional

import numpy as np

from deformable_manipulation.scenario.spec import KnowledgeSpec

_WANDERING = 10.0  # s, in which the hidden piece goes along the object and back


class Picture(NamedTuple):
    """What is seen at one time."""

    time: float  # s, since the start
    points: np.ndarray  # (K, 3) m
    places: Optional[np.ndarray]  # (K,) m, along the object from its first end; None: not known


class Camera:
    """Takes pictures of a line, and delivers each after the delay.

    Args:
        knowledge: rate, noise, delay, what is hidden.
        length: of the object [m].
        random: numpy's Generator.
    """

    def __init__(self, knowledge: KnowledgeSpec, length: float, random: np.random.Generator):
        self._knowledge = knowledge
        self._length = length
        self._random = random
        self._taken = 0
        self._phase = random.uniform(0.0, 2.0 * math.pi)
        self._under_way: Deque[Picture] = deque()

    def look(self, time: float, points: np.ndarray) -> Optional[Picture]:
        """The newest picture that arrives with a state.

        Args:
            time: [s] of the state.
            points: (P, 3) [m] of the object, at equal arc lengths.

        Returns:
            None if none arrives, or it shows nothing.
        """
        due = int(time * self._knowledge.camera_rate + 1e-9) + 1
        if due > self._taken:
            self._taken = due
            self._under_way.append(self._take(time, points))
        arrived = None
        while (
            self._under_way
            and self._under_way[0].time <= time - self._knowledge.camera_delay + 1e-9
        ):
            arrived = self._under_way.popleft()
        return arrived if arrived is not None and len(arrived.points) else None

    def _take(self, time: float, points: np.ndarray) -> Picture:
        seen = self._seen(time)
        arcs = np.linspace(0.0, 1.0, len(points))
        exact = np.stack([np.interp(seen, arcs, axis) for axis in points.T], axis=1)
        noise = self._knowledge.camera_noise * self._random.standard_normal(exact.shape)
        places = self._length * seen if self._knowledge.camera_places else None
        return Picture(time, exact + noise, places)

    def _seen(self, time: float) -> np.ndarray:
        """The places (K,) that are not hidden, as parts of the length."""
        places = np.linspace(0.0, 1.0, self._knowledge.camera_points)
        hidden = self._knowledge.camera_hidden
        middle = 0.5 + 0.5 * math.sin(2.0 * math.pi * time / _WANDERING + self._phase)
        begin = middle * (1.0 - hidden)
        return places[(places < begin) | (places > begin + hidden)] if hidden > 0.0 else places
