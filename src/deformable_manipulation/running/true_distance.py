"""How far the object really is from the obstacles, whatever the controllers know of them."""

from typing import Tuple

import numpy as np

from deformable_manipulation.control.observation import Observation
from deformable_manipulation.distance.factory import make_minimum_distance
from deformable_manipulation.motion.obstacle_motion import MovingObstacles
from deformable_manipulation.obstacles.spec import are_as_known
from deformable_manipulation.scenario.spec import Scenario


class TrueDistance:
    """Judges a run.

    Args:
        scenario: the checked scenario.
        simulation: that tells the time.

    Attributes:
        warnings: sentences about the obstacles' shapes.
    """

    def __init__(self, scenario: Scenario, simulation):
        self._simulation = simulation
        self._is_seen = are_as_known(scenario.obstacles)
        self._distance = make_minimum_distance(scenario)
        self.warnings: Tuple[str, ...] = tuple(getattr(self._distance, "warnings", ()))
        self._obstacles = MovingObstacles(scenario)

    def of(self, points: np.ndarray) -> float:
        """Present signed distance [m] of the object (1, P, 3) [m]; infinite without obstacles."""
        self._obstacles.move(self._distance, self._simulation.time)
        return float(self._distance.compute(points).minimum[0])

    def in_observation(self, observation: Observation) -> float:
        """The same of what the controllers observe; where they know everything, it is theirs."""
        if self._is_seen:
            return float(observation.distances.minimum[0])
        return self.of(observation.points[:1])
