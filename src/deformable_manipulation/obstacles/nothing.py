"""Where an obstacle may be, but nothing is known of it."""

from dataclasses import dataclass
from typing import Any, ClassVar, List, Tuple

import numpy as np

from deformable_manipulation.obstacles.drawings import Dots, Drawing
from deformable_manipulation.obstacles.spec import ObstacleSpec


def nothing() -> Any:
    """The C++ core's obstacle that is infinitely far away."""
    from deformable_manipulation import _distance

    return _distance.CloudObstacle([], 0.0)


@dataclass(frozen=True)
class Nothing(ObstacleSpec):
    """In place of an obstacle that somebody does not know."""

    kind: ClassVar[str] = "nothing"
    name: str
    translation = (0.0, 0.0, 0.0)
    rotation = (0.0, 0.0, 0.0, 1.0)
    motion = None
    known = True
    real = False

    def native(self) -> Tuple[Any, List[str]]:
        """See :class:`.ObstacleSpec`, like the others."""
        return nothing(), []

    def corners(self) -> np.ndarray:
        return np.empty((0, 3))

    def drawing(self) -> Drawing:
        return Dots(np.empty((0, 3)), 1.0)

    def description(self) -> str:
        return "not known"
