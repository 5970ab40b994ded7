"""What the paper reports: table of execution times and lowest distances of its simulations.

Aksoy and Wen, "Collaborative Manipulation of Deformable Objects with Predictive Obstacle
Avoidance". Its times are averages [ms] on an Intel Core i9-10885H.
"""

from typing import Dict, NamedTuple, Optional, Tuple


class Published(NamedTuple):
    """The paper's numbers of one scenario; None: not reported."""

    offset: float  # m, distance to keep
    snapshots: Tuple[float, ...]  # s, times of its pictures
    times: Optional[Tuple[float, float, float]] = None
    # ms: an iteration of the 3 + 1 simulations of an agent, a minimum distance, a quadratic program
    min_distance: Optional[float] = None  # m


PUBLISHED: Dict[str, Published] = {
    "rope_one_assistant": Published(0.05, (30.0, 60.0, 130.0, 160.0), (1.5, 0.3, 8.2), 0.031),
    "stiff_rod_one_assistant": Published(0.05, (30.0, 60.0, 120.0, 150.0)),
    "rope_two_assistants": Published(0.05, (20.0, 40.0, 120.0, 140.0), (2.0, 0.4, 9.0)),
    "fabric_three_assistants": Published(0.1, (100.0, 300.0, 750.0, 900.0), (0.2, 7.4, 9.1)),
}
