"""What a controller that looks ahead needs of the scenario."""

import dataclasses
from typing import Optional

import numpy as np

from deformable_manipulation import _control
from deformable_manipulation.distance.minimum_distance import MinimumDistance
from deformable_manipulation.motion.obstacle_motion import MovingObstacles, ObstaclePath
from deformable_manipulation.objects.body import make_body
from deformable_manipulation.scenario.spec import PathMotion, Scenario
from deformable_manipulation.seeing.seen_obstacles import SeenObstacles

_STEP = 0.02  # s, between poses on a path: straight in between, it is exact to some micrometres
_MOST_POSES = 20000  # of a path; a longer one is told less finely


class Forecast:
    """The object as it rests when its agents have moved on, and the obstacles it may meet there.

    Obstacles whose poses are measured go on with their present velocity.

    Args:
        scenario: the checked scenario.

    Attributes:
        triangles: of the object's points, or None: a polyline.
        has_shapes: whether the object's shapes can be found; otherwise they are told to first
            order.
        knows_all: whether no obstacle's poses are measured, and none is live.
    """

    def __init__(self, scenario: Scenario):
        self._known = tuple(
            obstacle
            for obstacle in scenario.obstacles
            if obstacle.known
            and (obstacle.motion is None or isinstance(obstacle.motion, PathMotion))
        )
        self._body = make_body(
            scenario.object, scenario.simulation.gravity, scenario.simulation.solver
        )
        self._holds = [
            (agent.particle, agent.hold, agent.start, agent.orientation)
            for agent in scenario.agents
        ]
        self.has_shapes = self.make_shapes() is not None
        self._all = scenario.obstacles
        self.knows_all = all(
            not each.is_live and each in self._known for each in scenario.obstacles if each.known
        )
        self.triangles = scenario.object.faces()
        self._margin = scenario.object.margin
        self._present: Optional[MinimumDistance] = None  # until it is needed
        self._seen: Optional[SeenObstacles] = None  # likewise
        self._obstacles = MovingObstacles(dataclasses.replace(scenario, obstacles=self._known))

    def make_shapes(self):
        """A new ``_pbd.RestShapes``, or None: such objects are predicted to first order."""
        return self._body.rest_shapes(self._holds)

    def standing(self):
        """A new ``_distance.MinimumDistance`` from the obstacles that do not move.

        Live ones are what :meth:`show` got last.
        """
        standing = [each for each in self._known if each.motion is None]
        distance = self._distance_from(standing)
        places = {
            index: standing.index(each) for index, each in enumerate(self._all) if each.is_live
        }
        self._seen = SeenObstacles(distance, places)
        return distance.native

    def show(self, seen) -> None:
        """Look ahead to what is seen of live obstacles, by their indices."""
        if self._seen is not None:
            self._seen.show(seen)

    def moving(self):
        """New ``_control.ObstacleForecast`` of the obstacles on paths."""
        return [self._on_path(each) for each in self._known if each.motion is not None]

    @property
    def distance(self):
        """The ``_distance.MinimumDistance`` from all these obstacles where they are at present."""
        if self._present is None:
            self._present = self._distance_from(self._known)
        return self._present.native

    def move(self, time: float) -> None:
        """Put the obstacles where they are at a time [s], if anybody uses their distances."""
        if self._present is not None:
            self._obstacles.move(self._present, time)

    def _distance_from(self, obstacles):
        return MinimumDistance(obstacles, self._margin, 0.0, self.triangles)

    def measured(self):
        """New ``_control.MeasuredObstacle`` of the obstacles whose poses are measured."""
        moving = [each for each in self._all if each.motion is not None]
        return [
            _control.MeasuredObstacle(self._distance_from([each]).native, _place(each), index)
            for index, each in enumerate(moving)
            if each.known and not isinstance(each.motion, PathMotion)
        ]

    def _on_path(self, obstacle):
        begin, step, poses = sampled(obstacle)
        distance = self._distance_from([obstacle]).native
        return _control.ObstacleForecast(distance, _place(obstacle), begin, step, poses)


def _place(obstacle):
    return (*obstacle.translation, *obstacle.rotation)


def sampled(obstacle):
    """The path of an obstacle: time of its first pose [s], step [s], poses (K, 7)."""
    times = [waypoint.time for waypoint in obstacle.motion.waypoints]
    duration = times[-1] - times[0]
    count = min(int(np.ceil(duration / _STEP)), _MOST_POSES) + 1
    step = duration / (count - 1) if count > 1 else _STEP
    path = ObstaclePath(obstacle)
    poses = (path.at(times[0] + k * step) for k in range(count))
    return times[0], step, np.array([pose.translation + pose.rotation for pose in poses])
