"""What a controller that looks ahead needs of the scenario."""

import numpy as np

from deformable_manipulation import _control
from deformable_manipulation.distance.minimum_distance import MinimumDistance
from deformable_manipulation.motion.obstacle_motion import ObstaclePath
from deformable_manipulation.objects.body import make_body
from deformable_manipulation.scenario.spec import PathMotion, Scenario

_STEP = 0.02  # s, between poses on a path: straight in between, it is exact to some micrometres
_MOST_POSES = 20000  # of a path; a longer one is told less finely


class Forecast:
    """The object as it rests when its agents have moved on, and the obstacles it may meet there.

    Obstacles on a path are where it leads. Those whose poses are measured are left out: nobody
    tells where they will be.

    Args:
        scenario: the checked scenario.
    """

    def __init__(self, scenario: Scenario):
        body = make_body(scenario.object, scenario.simulation.gravity, scenario.simulation.solver)
        #: ``_pbd.RestShapes``, or None where shapes are told to first order.
        self.shapes = body.rest_shapes(
            [
                (agent.particle, agent.hold, agent.start, agent.orientation)
                for agent in scenario.agents
            ]
        )
        self.triangles = scenario.object.faces()
        self._margin = scenario.object.margin
        #: ``_distance.MinimumDistance`` from the obstacles that stand.
        self.standing = self._distance_from(each for each in scenario.obstacles if not each.motion)
        #: ``_control.ObstacleForecast`` of each obstacle on a path.
        self.moving = [
            self._on_path(each)
            for each in scenario.obstacles
            if isinstance(each.motion, PathMotion)
        ]

    def _distance_from(self, obstacles):
        obstacles = tuple(obstacles)
        return MinimumDistance(obstacles, self._margin, 0.0, self.triangles).native

    def _on_path(self, obstacle):
        begin, step, poses = sampled(obstacle)
        place = (*obstacle.translation, *obstacle.rotation)
        return _control.ObstacleForecast(self._distance_from([obstacle]), place, begin, step, poses)


def sampled(obstacle):
    """The path of an obstacle: time of its first pose [s], step [s], poses (K, 7)."""
    times = [waypoint.time for waypoint in obstacle.motion.waypoints]
    duration = times[-1] - times[0]
    count = min(int(np.ceil(duration / _STEP)), _MOST_POSES) + 1
    step = duration / (count - 1) if count > 1 else _STEP
    path = ObstaclePath(obstacle)
    poses = (path.at(times[0] + k * step) for k in range(count))
    return times[0], step, np.array([pose.translation + pose.rotation for pose in poses])
