"""What a controller that looks ahead needs of the scenario."""

import dataclasses

from deformable_manipulation.distance.minimum_distance import MinimumDistance
from deformable_manipulation.motion.obstacle_motion import MovingObstacles
from deformable_manipulation.objects.body import make_body
from deformable_manipulation.scenario.spec import PathMotion, Scenario


class Forecast:
    """The object as it rests when its agents have moved on, and the obstacles it may meet there.

    Obstacles whose poses are measured are left out: nobody tells where they will be.

    Args:
        scenario: the checked scenario.
    """

    def __init__(self, scenario: Scenario):
        known = tuple(
            obstacle
            for obstacle in scenario.obstacles
            if obstacle.motion is None or isinstance(obstacle.motion, PathMotion)
        )
        body = make_body(scenario.object, scenario.simulation.gravity, scenario.simulation.solver)
        self.shapes = body.rest_shapes(
            [
                (agent.particle, agent.hold, agent.start, agent.orientation)
                for agent in scenario.agents
            ]
        )
        self.triangles = scenario.object.faces()
        self._distance = MinimumDistance(
            known, scenario.object.margin, band=0.0, triangles=self.triangles
        )
        self._obstacles = MovingObstacles(dataclasses.replace(scenario, obstacles=known))

    @property
    def distance(self):
        """The ``_distance.MinimumDistance`` from these obstacles."""
        return self._distance.native

    def move(self, time: float) -> None:
        """Put the obstacles where they are at a time [s]."""
        self._obstacles.move(self._distance, time)
