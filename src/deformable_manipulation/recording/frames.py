"""Where the object and the agents of a recorded run were, now and then."""

from dataclasses import dataclass
from typing import Optional, Tuple

import numpy as np

from deformable_manipulation.motion.obstacle_motion import placed_obstacles
from deformable_manipulation.scenario.spec import Scenario


@dataclass(frozen=True)
class Frames:
    """F frames of a run: A agents, P geometry points of the object itself."""

    scenario: Scenario
    times: np.ndarray  # (F,) s, increasing
    points: np.ndarray  # (F, P, 3) m
    agents: np.ndarray  # (F, A, 3) m, held points, in the scenario's order
    obstacles: Optional[np.ndarray] = None  # (F, K, 7) poses of the moving ones; None: not recorded

    @property
    def faces(self) -> Optional[np.ndarray]:
        """Triangles (T, 3) of a surface; None of a line."""
        return self.scenario.object.faces()

    def at(self, time: float) -> int:
        """Index of the frame nearest to a time [s]."""
        return int(np.argmin(np.abs(self.times - time)))

    def obstacles_at(self, frame: int) -> tuple:
        """The scenario's obstacles, where they were in a frame."""
        if self.obstacles is None:
            return self.scenario.obstacles
        return placed_obstacles(self.scenario, self.obstacles[frame])

    def between(self, time: float) -> Tuple[np.ndarray, np.ndarray]:
        """Points (P, 3) and held points (A, 3) [m] at a time [s], linear between frames."""
        after = int(np.clip(np.searchsorted(self.times, time), 1, max(len(self.times) - 1, 1)))
        after = min(after, len(self.times) - 1)
        before = max(after - 1, 0)
        span = float(self.times[after] - self.times[before])
        share = min(max((time - float(self.times[before])) / span, 0.0), 1.0) if span else 0.0
        return tuple(
            (1.0 - share) * values[before].astype(float) + share * values[after].astype(float)
            for values in (self.points, self.agents)
        )
