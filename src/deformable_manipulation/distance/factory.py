"""The distance computation for a scenario."""

from typing import Any, Sequence

from deformable_manipulation.distance.minimum_distance import MinimumDistance
from deformable_manipulation.obstacles.nothing import Nothing
from deformable_manipulation.obstacles.spec import ObstacleSpec
from deformable_manipulation.scenario.spec import Scenario


def make_minimum_distance(scenario: Scenario):
    """The distance computation for a scenario's object and all obstacles, by the chosen backend.

    Of live obstacles there is nothing.

    Raises:
        ValueError: an obstacle's file cannot be read, or its shape is invalid.
    """
    return _distance_from(scenario, scenario.obstacles)


def make_known_distance(scenario: Scenario):
    """The same with the obstacles that the controllers know; the others are nowhere.

    Of live obstacles there is nothing yet: :class:`~..seeing.seen_obstacles.SeenObstacles` puts
    what is seen into their places.
    """
    obstacles = [each if each.known else Nothing(each.name) for each in scenario.obstacles]
    return _distance_from(scenario, obstacles)


def _distance_from(scenario: Scenario, obstacles: Sequence[ObstacleSpec]):
    body, collision = scenario.object, scenario.controller.collision
    backend: Any = MinimumDistance
    if collision.backend == "reference":
        # Imported late: only comparisons need its libraries.
        from deformable_manipulation.distance.reference import ReferenceMinimumDistance

        backend = ReferenceMinimumDistance
    return backend(obstacles, body.margin, collision.band, body.faces())
