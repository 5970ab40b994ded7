"""Random smooth paths of a leader close over obstacles."""

from typing import Callable, List

import numpy as np

from deformable_manipulation.motion.leader import LeaderPath
from deformable_manipulation.scenario.spec import Waypoint

# Mean speed of a piece in multiples of the speed allowed: from rest to rest the peak is 15/8 of it.
_PACE = (0.3, 0.53)
_REST = 12.0  # s, at the end: time to see whether the assistants come back
_APPROACH = 2.0  # s, at rest at the start
_NEAR = 0.3  # m: a place is near the obstacles up to this much farther than the clearance
_SHARE_NEAR = 0.85  # of the waypoints
_CANDIDATES = 256  # places from which a near one is chosen
_DRAWS = 10  # of the next place, until one is found that leaves time for the way back
_SAMPLES = 400  # points of a path at which its clearance and speed are looked at
_ATTEMPTS = 30


class NoPath(RuntimeError):
    """No path was found that is short enough and keeps the leader's grip clear."""


def random_path(
    random: np.random.Generator,
    low: np.ndarray,
    high: np.ndarray,
    speed: float,
    duration: float,
    clearance: Callable[[np.ndarray], np.ndarray],
    keep: float,
) -> List[Waypoint]:
    """Waypoints of a path that goes from place to place near the obstacles, and back to rest.

    Args:
        low, high: (3,) corners of the box that the places are in [m], relative to the leader's
            start at the origin.
        speed: that no component of the leader's velocity exceeds [m/s].
        duration: of the whole path [s], the rest at both ends included.
        clearance: distances (N,) [m] of leader positions (N, 3), relative to the start, from all
            obstacles.
        keep: clearance that the leader's grip keeps [m].

    Raises:
        NoPath: none was found.
    """
    times = np.linspace(0.0, duration, _SAMPLES)
    for _ in range(_ATTEMPTS):
        waypoints = _draw(random, low, high, speed, duration, clearance, keep)
        path = LeaderPath(waypoints)
        fastest = np.abs(path.velocity(times)).max()
        if fastest <= speed and clearance(path.position(times)).min() >= keep:
            return waypoints
    raise NoPath(
        f"none of {_ATTEMPTS} random paths keeps the leader {keep:g} m clear of the obstacles"
    )


def _draw(random, low, high, speed, duration, clearance, keep) -> List[Waypoint]:
    """Waypoints that a pace within the speed reaches in time for the way back."""
    home = np.zeros(3)
    waypoints = [Waypoint(0.0, tuple(home)), Waypoint(_APPROACH, tuple(home))]
    time, place = _APPROACH, home
    slowest_return = _PACE[1] * speed

    def next_waypoint():
        for _ in range(_DRAWS):
            target = _place(random, low, high, clearance, keep)
            arrival = time + _travel(place, target, speed * random.uniform(*_PACE))
            if arrival + _travel(target, home, slowest_return) + _REST <= duration:
                return arrival, target
        return None

    found = next_waypoint()
    if found is None:
        raise NoPath(
            f"{duration:g} s are too short for a path out and back at {speed:g} m/s with "
            f"{_APPROACH + _REST:g} s of rest"
        )
    while found is not None:
        time, place = found
        waypoints.append(Waypoint(time, tuple(place)))
        found = next_waypoint()
    waypoints.append(Waypoint(time + _travel(place, home, slowest_return), tuple(home)))
    return [_plain(waypoint) for waypoint in waypoints]


def _plain(waypoint: Waypoint) -> Waypoint:
    """The waypoint in Python's own numbers, as a scenario file has them."""
    x, y, z = map(float, waypoint.position)
    return Waypoint(float(waypoint.time), (x, y, z))


def _place(random, low, high, clearance, keep) -> np.ndarray:
    """A place in the box, mostly one that is near the obstacles."""
    candidates = random.uniform(low, high, (_CANDIDATES, 3))
    if random.uniform() < _SHARE_NEAR:
        distances = clearance(candidates)
        near = candidates[(distances >= keep) & (distances <= keep + _NEAR)]
        if len(near):
            return near[0]
    return candidates[0]


def _travel(start, end, pace) -> float:
    """Time [s] between two places at a mean speed of the fastest component."""
    return max(float(np.abs(end - start).max()) / pace, 1.0)
