"""Random smooth paths of a leader close over obstacles."""

from typing import Callable, List, Optional

import numpy as np

from deformable_manipulation.motion.leader import LeaderPath
from deformable_manipulation.scenario.spec import Waypoint

PLACES, DIVES = "places", "dives"

# Mean speed of a piece in multiples of the speed allowed: from rest to rest the peak is 15/8 of it.
_PACE = (0.3, 0.53)
_REST = 12.0  # s, at the end: time to see whether the assistants come back
_APPROACH = 2.0  # s, at rest at the start
_NEAR = 0.3  # m: a place is near the obstacles up to this much farther than the clearance
_SHARE_NEAR = 0.85  # of the waypoints
_DROPS = (0.3, 0.8)  # m, that a dive goes straight down
_STAY = (0.5, 3.0)  # s, at rest after a dive
_CANDIDATES = 256  # places from which a near one is chosen
_DRAWS = 10  # of the next place, until one is found that leaves time for the way back
_SAMPLES = 400  # points of a path at which its clearance and speed are looked at
_ATTEMPTS = 30
_LEAST_TIME = 1e-3  # s, of a dive that has no room


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
    kind: str = PLACES,
) -> List[Waypoint]:
    """Waypoints of a path that goes from place to place near the obstacles, and back to rest.

    With the kind DIVES it goes to a point above each place and from there straight down, with the
    speed allowed at its fastest.

    Args:
        low, high: (3,) corners of the box that the places are in [m], relative to the leader's
            start at the origin.
        speed: that no component of the leader's velocity exceeds [m/s].
        duration: of the whole path [s], the rest at both ends included.
        clearance: distances (N,) [m] of leader positions (N, 3), relative to the start, from all
            obstacles.
        keep: clearance that the leader's grip keeps [m].
        kind: PLACES or DIVES.

    Raises:
        NoPath: none was found.
    """
    times = np.linspace(0.0, duration, _SAMPLES)
    for _ in range(_ATTEMPTS):
        places = _Places(random, low, high, clearance, keep)
        waypoints = _draw(random, places, speed, duration, kind)
        path = LeaderPath(waypoints)
        fastest = np.abs(path.velocity(times)).max()
        if fastest <= speed and clearance(path.position(times)).min() >= keep:
            return waypoints
    raise NoPath(
        f"none of {_ATTEMPTS} random paths keeps the leader {keep:g} m clear of the obstacles"
    )


class _Places:
    """Places in a box, mostly near obstacles.

    Args:
        low, high, clearance, keep: see :func:`random_path`.
    """

    def __init__(self, random, low, high, clearance, keep):
        self._random = random
        self._low, self._high = low, high
        self._clearance = clearance
        self._keep = keep

    def draw(self) -> np.ndarray:
        """A place in the box, mostly one that is near the obstacles."""
        candidates = self._random.uniform(self._low, self._high, (_CANDIDATES, 3))
        if self._random.uniform() < _SHARE_NEAR:
            distances = self._clearance(candidates)
            near = candidates[(distances >= self._keep) & (distances <= self._keep + _NEAR)]
            if len(near):
                return near[0]
        return candidates[0]

    def above(self, place) -> np.ndarray:
        """Where a dive to a place begins: within the box."""
        height = min(place[2] + self._random.uniform(*_DROPS), max(self._high[2], place[2]))
        return np.array([place[0], place[1], height])


def _draw(random, places, speed, duration, kind) -> List[Waypoint]:
    """Waypoints that a pace within the speed reaches in time for the way back."""
    home = np.zeros(3)
    waypoints = [Waypoint(0.0, tuple(home)), Waypoint(_APPROACH, tuple(home))]
    leg = _dive if kind == DIVES else _way
    slowest_return = _PACE[1] * speed

    def next_leg() -> Optional[List[Waypoint]]:
        start, place = waypoints[-1].time, np.array(waypoints[-1].position)
        for _ in range(_DRAWS):
            found = leg(random, places, speed, start, place)
            last = found[-1]
            if last.time + _travel(last.position, home, slowest_return) + _REST <= duration:
                return found
        return None

    found = next_leg()
    if found is None:
        raise NoPath(
            f"{duration:g} s are too short for a path out and back at {speed:g} m/s with "
            f"{_APPROACH + _REST:g} s of rest"
        )
    while found is not None:
        waypoints += found
        found = next_leg()
    last = waypoints[-1]
    end = last.time + _travel(last.position, home, slowest_return)
    waypoints.append(Waypoint(end, tuple(home)))
    return [_plain(waypoint) for waypoint in waypoints]


def _way(random, places, speed, time, place) -> List[Waypoint]:
    """To another place."""
    target = places.draw()
    return [Waypoint(time + _travel(place, target, speed * random.uniform(*_PACE)), tuple(target))]


def _dive(random, places, speed, time, place) -> List[Waypoint]:
    """To above another place, straight down to it, and a while at rest."""
    target = places.draw()
    top = places.above(target)
    arrival = time + _travel(place, top, speed * random.uniform(*_PACE))
    down = arrival + (top[2] - target[2]) / (_PACE[1] * speed) + _LEAST_TIME
    return [
        Waypoint(arrival, tuple(top)),
        Waypoint(down, tuple(target)),
        Waypoint(down + random.uniform(*_STAY), tuple(target)),
    ]


def _plain(waypoint: Waypoint) -> Waypoint:
    """The waypoint in Python's own numbers, as a scenario file has them."""
    x, y, z = map(float, waypoint.position)
    return Waypoint(float(waypoint.time), (x, y, z))


def _travel(start, end, pace) -> float:
    """Time [s] between two places at a mean speed of the fastest component."""
    return max(float(np.abs(np.subtract(end, start)).max()) / pace, 1.0)
