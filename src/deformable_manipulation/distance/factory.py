"""The distance computation for a scenario."""

from typing import Any

from deformable_manipulation.distance.minimum_distance import MinimumDistance
from deformable_manipulation.scenario.spec import Scenario


def make_minimum_distance(scenario: Scenario):
    """The distance computation for a scenario's object and obstacles, by the chosen backend.

    Raises:
        ValueError: an obstacle's file cannot be read, or its shape is invalid.
    """
    body, collision = scenario.object, scenario.controller.collision
    backend: Any = MinimumDistance
    if collision.backend == "reference":
        # Imported late: only comparisons need its libraries.
        from deformable_manipulation.distance.reference import ReferenceMinimumDistance

        backend = ReferenceMinimumDistance
    return backend(scenario.obstacles, body.margin, collision.band, body.faces())
