"""Random smooth paths of a leader, for runs by the hundred."""

from dataclasses import dataclass
from typing import Callable, Tuple

import numpy as np

from deformable_manipulation.leader import LeaderPath
from deformable_manipulation.scenario.spec import Vector, Waypoint

_PATHS = 50  # tried before giving up
_PLACES = 200  # tried for one waypoint
_SLOWEST = 0.25  # of the top speed, mean over a leg
_TIMES_PER_LEG = 20  # at which clearance is asked for


@dataclass(frozen=True)
class PathLimits:
    """Where a leader goes and how fast.

    The path begins and ends at rest where the leader starts, and stays within a box.
    """

    lower: Vector  # m, corners of the box, relative to the leader's start
    upper: Vector
    top_speed: float  # m/s, no component is ever faster
    travel: float  # s, in which new places are chosen; the way back comes on top
    rest: float = 8.0  # s at rest at the end

    def __post_init__(self):
        lower, upper = np.asarray(self.lower, dtype=float), np.asarray(self.upper, dtype=float)
        if not (
            lower.shape == upper.shape == (3,)
            and np.isfinite([lower, upper]).all()
            and ((lower <= 0.0) & (upper >= 0.0)).all()
            and (lower < upper).any()
        ):
            raise ValueError(
                f"lower {self.lower}, upper {self.upper}: allowed are three finite numbers each, "
                "the start (0, 0, 0) in between, and some room"
            )
        for name in ("top_speed", "travel", "rest"):
            if not 0.0 < getattr(self, name) < np.inf:
                raise ValueError(f"{name}: {getattr(self, name)}, allowed are positive numbers")


def random_waypoints(
    generator: np.random.Generator,
    limits: PathLimits,
    is_clear: Callable[[np.ndarray], bool],
) -> Tuple[Waypoint, ...]:
    """Waypoints through random places of the box; the same for the same state of the generator.

    The mean speed of each leg is random, up to half the top speed, which :class:`LeaderPath` never
    more than doubles.

    Args:
        generator: source of all chance.
        limits: :class:`PathLimits`.
        is_clear: whether the leader may be at all of the positions (N, 3) [m], relative to its
            start.

    Raises:
        RuntimeError: no clear path was found; the box may be blocked.
    """
    for _ in range(_PATHS):
        waypoints = _candidate(generator, limits, is_clear)
        if waypoints is not None and is_clear(_positions(waypoints)):
            return waypoints
    raise RuntimeError(f"no clear path within {limits} in {_PATHS} attempts")


def _candidate(generator, limits, is_clear):
    """Waypoints whose straight legs are clear, or None where the leader got stuck."""
    lower, upper = np.asarray(limits.lower), np.asarray(limits.upper)
    time, here = 0.0, np.zeros(3)
    waypoints = [Waypoint(time, tuple(here.tolist()))]
    while time < limits.travel:
        there = _reachable(lambda: generator.uniform(lower, upper), here, is_clear)
        if there is None:
            return None
        time, here = time + _leg_time(generator, limits, there - here), there
        waypoints.append(Waypoint(time, tuple(here.tolist())))
    home = np.zeros(3)
    if not is_clear(np.linspace(here, home, _TIMES_PER_LEG)):
        return None
    time += _leg_time(generator, limits, here)
    waypoints.append(Waypoint(time, tuple(home.tolist())))
    return tuple(waypoints) + (Waypoint(time + limits.rest, waypoints[-1].position),)


def _reachable(draw, here, is_clear):
    for _ in range(_PLACES):
        there = draw()
        if is_clear(np.linspace(here, there, _TIMES_PER_LEG)):
            return there
    return None


def _leg_time(generator, limits, change):
    """s, at least one, for a leg at a random mean speed."""
    fraction = generator.uniform(_SLOWEST, 1.0)
    return max(1.0, 2.0 * np.abs(change).max() / (fraction * limits.top_speed))


def _positions(waypoints):
    path = LeaderPath(waypoints)
    times = np.concatenate(
        [
            np.linspace(before.time, after.time, _TIMES_PER_LEG)
            for before, after in zip(waypoints, waypoints[1:])
        ]
    )
    return path.position(times)
