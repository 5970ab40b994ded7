"""What a controller that looks ahead needs of the scenario."""

import dataclasses
import functools
from typing import Optional

from deformable_manipulation.distance.minimum_distance import MinimumDistance
from deformable_manipulation.motion.obstacle_motion import MovingObstacles
from deformable_manipulation.objects.body import make_body
from deformable_manipulation.scenario.spec import PathMotion, Scenario


class Forecast:
    """The object as it rests when its agents have moved on, and the obstacles it may meet there.

    Obstacles whose poses are measured are left out: nobody tells where they will be.

    Args:
        scenario: the checked scenario.

    Attributes:
        triangles: of the object's points, or None: a polyline.
        has_shapes: whether the object's shapes can be found; otherwise they are told to first
            order.
        knows_all: whether no obstacle is left out.
    """

    def __init__(self, scenario: Scenario):
        known = tuple(
            obstacle
            for obstacle in scenario.obstacles
            if obstacle.motion is None or isinstance(obstacle.motion, PathMotion)
        )
        self._body = make_body(
            scenario.object, scenario.simulation.gravity, scenario.simulation.solver
        )
        self._holds = [
            (agent.particle, agent.hold, agent.start, agent.orientation)
            for agent in scenario.agents
        ]
        self.has_shapes = self.make_shapes() is not None
        self.knows_all = len(known) == len(scenario.obstacles)
        self.triangles = scenario.object.faces()
        self._make_distance = functools.partial(
            MinimumDistance, known, scenario.object.margin, band=0.0, triangles=self.triangles
        )
        self._distance: Optional[MinimumDistance] = None  # until it is needed
        self._obstacles = MovingObstacles(dataclasses.replace(scenario, obstacles=known))

    def make_shapes(self):
        """A new ``_pbd.RestShapes``, or None: such objects are predicted to first order."""
        return self._body.rest_shapes(self._holds)

    @property
    def distance(self):
        """The ``_distance.MinimumDistance`` from these obstacles."""
        if self._distance is None:
            self._distance = self._make_distance()
        return self._distance.native

    def move(self, time: float) -> None:
        """Put the obstacles where they are at a time [s], if anybody uses their distances."""
        if self._distance is not None:
            self._obstacles.move(self._distance, time)
