"""Observations of a simulated object."""

from typing import Optional

from deformable_manipulation.control.observation import Observation
from deformable_manipulation.motion.intent import Intent
from deformable_manipulation.motion.obstacle_motion import MovingObstacles
from deformable_manipulation.scenario.spec import Scenario
from deformable_manipulation.seeing.carried_state import CarriedState
from deformable_manipulation.seeing.seen_obstacles import SeenObstacles, live_obstacles
from deformable_manipulation.seeing.sight import Sight


class Observer:
    """Makes the observations of a simulation, with its distances.

    Args:
        simulation: ``_pbd.Simulation``.
        distance: MinimumDistance or one like it.
        sight: what the controllers see of live obstacles; None: there are none.
        copies: False looks at the object itself alone, without its response to its agents.
    """

    def __init__(
        self,
        scenario: Scenario,
        simulation,
        distance,
        copies: bool = True,
        sight: Optional[Sight] = None,
    ):
        self._simulation = simulation
        self._distance = distance
        self._exact = copies and scenario.controller.jacobian == "equilibrium"
        self._turns = scenario.controller.turns
        self._wrenches = scenario.controller.needs_wrenches
        self._points = simulation.points()  # reused
        self._obstacles = MovingObstacles(scenario)
        self._sight = sight
        if sight is not None:
            self._seen = SeenObstacles(distance, {i: i for i in live_obstacles(scenario)})

    def observe(self, intent: Optional[Intent] = None) -> Observation:
        """The present state, with what the leader has announced.

        Its points are valid until the next call.
        """
        simulation = self._simulation
        points = simulation.points(out=self._points)
        if self._sight is not None:
            self._seen.show(self._sight.seen())
        distances = self.distances_of(points)  # moves the obstacles
        sensitivities = self._sensitivities()
        known = sensitivities is not None
        return Observation(
            time=simulation.time,
            cycle=simulation.cycle,
            positions=simulation.positions(),
            points=points,
            displaced_agents=simulation.displaced_agents(),
            displacements=simulation.displacements(),
            ready=simulation.ready(),
            distances=distances,
            sensitivities=sensitivities,
            correction=simulation.correction,
            wrenches=simulation.wrenches() if self._wrenches else None,
            wrench_sensitivities=simulation.wrench_response() if self._wrenches and known else None,
            orientations=simulation.orientations() if self._turns else None,
            turning_sensitivities=simulation.turning_response() if self._turns and known else None,
            obstacles=self._obstacles.poses(),
            seen={} if self._sight is None else self._sight.seen(),
            intent=intent,
        )

    def distances_of(self, points):
        """The distances of copies' points (C, P, 3) [m] from the obstacles as they stand now."""
        self._obstacles.move(self._distance, self._simulation.time)
        return self._distance.compute(points)

    def look(self) -> None:
        """Let the camera see the present state."""
        if self._sight is not None:
            simulation = self._simulation
            points, positions = self._points[0].copy(), simulation.positions()
            carried = CarriedState(simulation.time, points, positions, simulation.orientations())
            self._sight.look(simulation.cycle, carried)

    def obstacle_poses(self):
        """Where the moving obstacles were when last looked at, (K, 7)."""
        return self._obstacles.poses()

    def _sensitivities(self):
        """Exact response of the object, if it is wanted and known; else None."""
        if not self._exact:
            return None
        response = self._simulation.response()
        return None if isinstance(response, str) else response
