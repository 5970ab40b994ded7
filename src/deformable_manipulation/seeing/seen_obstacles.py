"""What is seen of obstacles, put into computations of distances."""

from typing import Any, Dict, List, Mapping

from deformable_manipulation.scenario.spec import Scenario
from deformable_manipulation.seeing.live_map import Seen


def live_obstacles(scenario: Scenario) -> List[int]:
    """Indices of the obstacles whose data come while the run goes on."""
    return [index for index, each in enumerate(scenario.obstacles) if each.is_live]


class SeenObstacles:
    """Puts what is seen into one computation of distances, whenever it is new.

    Args:
        distance: with a method ``replace(index, obstacle)``.
        places: places in it by the obstacles' indices in the scenario; default: the same.
    """

    def __init__(self, distance: Any, places: Mapping[int, int]):
        self._distance, self._places = distance, places
        self._shown: Dict[int, Seen] = {}

    def show(self, seen: Mapping[int, Seen]) -> None:
        """From now on, compute distances from what is seen, by the obstacles' indices."""
        for index, each in seen.items():
            if index in self._places and self._shown.get(index) is not each:
                self._distance.replace(self._places[index], each.obstacle())
                self._shown[index] = each
