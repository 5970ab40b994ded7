"""Observations of a simulated object."""

from typing import Optional

from deformable_manipulation.control.observation import Observation
from deformable_manipulation.motion.intent import Intent
from deformable_manipulation.motion.obstacle_motion import MovingObstacles
from deformable_manipulation.scenario.spec import Scenario


class Observer:
    """Makes the observations of a simulation, with its distances.

    Args:
        simulation: ``_pbd.Simulation``.
        distance: MinimumDistance or one like it.
        copies: False looks at the object itself alone, without its response to its agents.
    """

    def __init__(self, scenario: Scenario, simulation, distance, copies: bool = True):
        self._simulation = simulation
        self._distance = distance
        self._exact = copies and scenario.controller.jacobian == "equilibrium"
        self._points = simulation.points()  # reused
        self._obstacles = MovingObstacles(scenario)

    def observe(self, intent: Optional[Intent] = None) -> Observation:
        """The present state, with what the leader has announced.

        Its points are valid until the next call.
        """
        simulation = self._simulation
        points = simulation.points(out=self._points)
        distances = self.distances_of(points)  # moves the obstacles
        return Observation(
            time=simulation.time,
            cycle=simulation.cycle,
            positions=simulation.positions(),
            points=points,
            displaced_agents=simulation.displaced_agents(),
            displacements=simulation.displacements(),
            ready=simulation.ready(),
            distances=distances,
            sensitivities=self._sensitivities(),
            correction=simulation.correction,
            obstacles=self._obstacles.poses(),
            intent=intent,
        )

    def distances_of(self, points):
        """The distances of copies' points (C, P, 3) [m] from the obstacles as they stand now."""
        self._obstacles.move(self._distance, self._simulation.time)
        return self._distance.compute(points)

    def obstacle_poses(self):
        """Where the moving obstacles were when last looked at, (K, 7)."""
        return self._obstacles.poses()

    def _sensitivities(self):
        """Exact response of the object, if it is wanted and known; else None."""
        if not self._exact:
            return None
        response = self._simulation.response()
        return None if isinstance(response, str) else response
