"""An obstacle that is dragged by hand."""

import time

from deformable_manipulation.motion.bounded_motion import BoundedMotion
from deformable_manipulation.motion.steering import Hand

REACH = 1.0  # m, to each side of where it stands in the scenario


class DraggedObstacle:
    """Where an obstacle is that a hand drags: near its place in the scenario, turned as there.

    It moves no faster than the leader by hand: ``leader.max_velocity`` and
    ``leader.max_acceleration`` are what the assistants can answer.

    Args:
        obstacle: with ``translation`` (3,) [m].
        scenario: :class:`~deformable_manipulation.scenario.spec.Scenario`.
        clock: seconds, never decreasing; for the hand's timeouts.
    """

    def __init__(self, obstacle, scenario, clock=time.monotonic):
        self._start = tuple(obstacle.translation)
        self._cycle_time = scenario.cycle_time
        motion = BoundedMotion(
            [x - REACH for x in self._start],
            [x + REACH for x in self._start],
            scenario.leader.max_velocity,
            scenario.leader.max_acceleration,
            scenario.cycle_time,
        )
        self._hand = Hand(motion, scenario.controller.timeout, clock)
        self.drag, self.release = self._hand.drag, self._hand.release
        self.reset()

    def reset(self):
        """Back to its place, at rest."""
        self._hand.release()
        self._position = self._start
        self._velocity = (0.0, 0.0, 0.0)

    @property
    def position(self):
        """Where it is (3,) [m]."""
        return self._position

    @property
    def source(self):
        """DRAGGED or RESTING."""
        return self._hand.source

    def advance(self):
        """Move on by a cycle."""
        velocity = self._hand.velocity(self._position, self._velocity)
        self._position = tuple(
            x + self._cycle_time * v for x, v in zip(self._position, self._velocity)
        )
        self._velocity = velocity
