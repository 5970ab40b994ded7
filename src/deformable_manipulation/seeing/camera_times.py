"""When a simulated camera takes its images."""

import math
from typing import Optional

from deformable_manipulation.scenario.spec import Scenario

_ROUNDING = 1e-9


class CameraTimes:
    """The cycles in which an image is due: the first of each of the camera's periods.

    Args:
        scenario: the checked scenario, with a ``camera``.
    """

    def __init__(self, scenario: Scenario):
        if scenario.camera is None:
            raise ValueError("the scenario has no camera")
        self._per_cycle = scenario.camera.rate / scenario.controller.rate

    def number(self, cycle: int) -> int:
        """How many images are due in the cycles up to one, less one."""
        return math.floor(cycle * self._per_cycle + _ROUNDING)

    def is_due(self, cycle: int) -> bool:
        """Whether an image is due in a cycle."""
        return cycle == 0 or self.number(cycle) > self.number(cycle - 1)

    def last_before(self, cycle: int) -> Optional[int]:
        """The last cycle before one in which an image is due; None: there is none."""
        return next((each for each in range(cycle - 1, -1, -1) if self.is_due(each)), None)
