"""The distance computation for a scenario."""

from typing import Any, Sequence

from deformable_manipulation.distance.minimum_distance import MinimumDistance
from deformable_manipulation.obstacles.nothing import Nothing
from deformable_manipulation.scenario.spec import Scenario


def make_minimum_distance(scenario: Scenario):
    """The distance computation for a scenario's object and obstacles, by the chosen backend.

    From those that are really there; maps of them are nowhere.

    Raises:
        ValueError: an obstacle's file cannot be read, or its shape is invalid.
    """
    return _distance_from(scenario, [each.real for each in scenario.obstacles])


def make_known_distance(scenario: Scenario):
    """The same with the obstacles that the controllers know; the others are nowhere.

    Of live obstacles there is nothing yet: :class:`~..seeing.seen_obstacles.SeenObstacles` puts
    what is seen into their places.
    """
    return _distance_from(scenario, [each.known for each in scenario.obstacles])


def _distance_from(scenario: Scenario, counts: Sequence[bool]):
    """From those obstacles that count; the others keep their places in the results."""
    obstacles = [
        each if each_counts else Nothing(each.name)
        for each, each_counts in zip(scenario.obstacles, counts)
    ]
    body, collision = scenario.object, scenario.controller.collision
    backend: Any = MinimumDistance
    if collision.backend == "reference":
        # Imported late: only comparisons need its libraries.
        from deformable_manipulation.distance.reference import ReferenceMinimumDistance

        backend = ReferenceMinimumDistance
    return backend(obstacles, body.margin, collision.band, body.faces())
