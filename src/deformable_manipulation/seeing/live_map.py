"""What has come of one live obstacle, and what is made of it."""

import math
import threading
from typing import Any, NamedTuple, Optional, Sequence, Tuple, cast

import numpy as np

from deformable_manipulation.geometry.pose import Quaternion, Vector
from deformable_manipulation.geometry.rotation import rotate
from deformable_manipulation.obstacles.live import LiveObstacle, SeenPoints
from deformable_manipulation.scenario.spec import Scenario
from deformable_manipulation.seeing.carried_state import CarriedState
from deformable_manipulation.seeing.own_points import FindFrame, OwnPoints

_MOST_PIECES = 32  # that are held: memory has an end, whatever the rate
_TOLERANCE = 1e-9  # s, of times


class Piece(NamedTuple):
    """Data of one time."""

    time: float  # s
    what: Any  # of LiveObstacle.piece
    places: np.ndarray  # (N, 3) m, points in the fixed frame that were not left out


class Seen:
    """An obstacle as it is known at a time; it does not change.

    Args:
        spec: of the obstacle.
        pieces: of it, the newest last.
    """

    def __init__(self, spec: LiveObstacle, pieces: Sequence[Piece]):
        self._spec, self._pieces = spec, tuple(pieces)
        self._ready: Optional[Any] = None
        self._lock = threading.Lock()

    @property
    def time(self) -> float:
        """When the newest of it was seen [s]."""
        return self._pieces[-1].time

    @property
    def places(self) -> Tuple[np.ndarray, ...]:
        """Points (N, 3) [m] of each time in the fixed frame, without what was left out."""
        return tuple(piece.places for piece in self._pieces)

    def prepare(self, points: np.ndarray, faces: Optional[np.ndarray]) -> None:
        """Let the first one who asks for the obstacle have it with all near (C, P, 3) found."""
        ready = self._make()
        ready.warm(points, faces)
        self._ready = ready

    def obstacle(self) -> Any:
        """A new obstacle of the C++ core, for one thread."""
        with self._lock:
            ready, self._ready = self._ready, None
        return self._make() if ready is None else ready

    def _make(self) -> Any:
        return self._spec.made_of([piece.what for piece in self._pieces])


class LiveMap:
    """Keeps what comes of one live obstacle, as long as it counts.

    :meth:`take` may be called by another thread than the rest.

    Args:
        scenario: the checked scenario.
        index: of the obstacle.
    """

    def __init__(self, scenario: Scenario, index: int):
        self.spec = cast(LiveObstacle, scenario.obstacles[index])
        self._own = OwnPoints(scenario, self.spec)
        self._faces = scenario.object.faces()
        self._pieces: Tuple[Piece, ...] = ()
        #: What is known; None: nothing has come yet.
        self.seen: Optional[Seen] = None

    def take(
        self,
        time: float,
        values: np.ndarray,
        pose: Tuple[Vector, Quaternion],
        state: CarriedState,
        find_frame: Optional[FindFrame],
        copies: Optional[np.ndarray] = None,
    ) -> None:
        """Take in data; whoever asks for what is known next gets them, too.

        Args:
            time: [s] that they are of; newer than those before, or time was set back.
            values: (N, K) the fields that the obstacle asks for; (H, W, K) of an image.
            pose: of their frame in the fixed frame, translation [m] and rotation, at that time.
            state: the carried object at that time.
            find_frame: where tf frames were then; None: there is no tf.
            copies: (C, P, 3) [m] of the object now, to have the nearest pairs ready for them.

        Raises:
            ValueError: they cannot be used; a clause that says why. What was known stays.
        """
        values = self.spec.cleaned(values)
        finite = np.isfinite(values[:, 0] + values[:, 1] + values[:, 2])
        values = values if finite.all() else values[finite]
        places = _placed(values[:, :3], *pose)
        own = self._own.mark(places, pose[0], state, find_frame)
        if own.any():
            values, places = values[~own], places[~own]
        piece = Piece(time, self.spec.piece(SeenPoints(values, places, *pose)), places)
        seen = Seen(self.spec, [*self._held(time), piece])
        if copies is not None:
            seen.prepare(copies, self._faces)
        self._pieces, self.seen = seen._pieces, seen

    def forget(self) -> None:
        """Go back to the start."""
        self._pieces, self.seen = (), None

    def fault(self, now: float) -> str:
        """Why it is not known at a time [s], as a clause; empty if it is."""
        if self.seen is None:
            return "nothing has come yet"
        age = now - self.seen.time
        if age > self.spec.timeout:
            return f"nothing that can be used has come for {age:.1f} s"
        if age < -self.spec.timeout:
            return f"what has come is {-age:.1f} s in the future; synchronise the clocks"
        return ""

    def _held(self, time: float) -> Tuple[Piece, ...]:
        """What was known before, as far as it is to be kept beside what is of a time [s]."""
        oldest = time - self.spec.hold - _TOLERANCE
        kept = tuple(each for each in self._pieces if oldest <= each.time < time)
        return kept[-(_MOST_PIECES - 1) :] if self.spec.hold > 0.0 else ()


def _placed(points: np.ndarray, translation: Vector, rotation: Quaternion) -> np.ndarray:
    """Points (N, 3) of a frame in the fixed frame, in single precision about as fine as theirs."""
    if rotation == (0.0, 0.0, 0.0, 1.0) and not any(translation):
        return np.ascontiguousarray(points)
    columns = np.array([rotate(rotation, tuple(axis)) for axis in np.eye(3)])
    farthest = max(map(abs, translation))
    kind = np.float32 if points.dtype == np.float32 and farthest < 10.0 else np.float64
    return (points.astype(kind) @ columns.astype(kind)) + np.array(translation, kind)


def is_later(time: float, before: float, timeout: float) -> bool:
    """Whether data of a time [s] follow those of another, or time was set back between them."""
    return time > before or not math.isfinite(before) or time < before - timeout
