"""What a leader announces in a run without ROS, right or wrong."""

from typing import Callable, Dict, Optional

import numpy as np

from deformable_manipulation.motion.intent import Intent
from deformable_manipulation.scenario import knowledge
from deformable_manipulation.scenario.spec import Scenario

_DELAY = 1.0  # s
_SCALE = 2.0
_PERIOD = 1.0  # s, with one random velocity
_RANDOM_SPEED = 0.3  # m/s, that no component exceeds


class Announcer:
    """Announces where the leader will be, as ``knowledge.intent`` says.

    Args:
        scenario: the checked scenario.
        leader: :class:`~deformable_manipulation.motion.leader.LeaderController` of it.
    """

    def __init__(self, scenario: Scenario, leader):
        self._wanted = scenario.controller.horizon.announced
        self._leader = leader
        self._seed = scenario.knowledge.seed
        kinds: Dict[str, Callable[[float], Intent]] = {
            knowledge.HONEST: leader.intent,
            knowledge.OPPOSITE: lambda time: self._scaled(time, -1.0),
            knowledge.DELAYED: self._delayed,
            knowledge.SCALED: lambda time: self._scaled(time, _SCALE),
            knowledge.RANDOM: self._random,
        }
        self._announce = kinds[scenario.knowledge.intent]

    def announce(self, time: float) -> Optional[Intent]:
        """The Intent that answers the state of a time [s]; None where nobody wants to know."""
        return self._announce(time) if self._wanted else None

    def _scaled(self, time, factor):
        intent = self._leader.intent(time)
        start = intent.positions[0]
        return Intent(intent.times, start + factor * (intent.positions - start))

    def _delayed(self, time):
        earlier = self._leader.intent(time - _DELAY)
        return Intent(earlier.times + _DELAY, earlier.positions)

    def _random(self, time):
        intent = self._leader.intent(time)
        random = np.random.default_rng([self._seed, int(time / _PERIOD)])
        velocity = random.uniform(-_RANDOM_SPEED, _RANDOM_SPEED, 3)
        ahead = intent.times - intent.times[0]
        return Intent(intent.times, intent.positions[0] + ahead[:, None] * velocity)
