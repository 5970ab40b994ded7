"""What the paper reports: table of execution times and lowest distances of its simulations.

Aksoy and Wen, "Collaborative Manipulation of Deformable Objects with Predictive Obstacle
Avoidance". Its times are averages [ms] on an Intel Core i9-10885H.
"""

from typing import Dict, NamedTuple, Optional


class Published(NamedTuple):
    """The paper's numbers of one scenario; None: not reported."""

    simulation: float  # ms, per iteration of the 3 + 1 simulations of an agent
    distance: float  # ms, of one minimum distance
    solver: float  # ms, of one quadratic program
    min_distance: Optional[float] = None  # m


PUBLISHED: Dict[str, Published] = {
    "rope_one_assistant": Published(1.5, 0.3, 8.2, 0.031),
    "rope_two_assistants": Published(2.0, 0.4, 9.0),
    "fabric_three_assistants": Published(0.2, 7.4, 9.1),
}
