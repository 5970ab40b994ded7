"""One rod in one library: drawn in, left to come to rest, timed. The same for every library.

Runs in the interpreter of the library: nothing but numpy is needed.
"""

from abc import ABC, abstractmethod
from collections import deque
from dataclasses import dataclass, field
from typing import List, Optional, Sequence, Tuple

import numpy as np

from deformable_manipulation.benchmarks.harness import Effort, measure
from deformable_manipulation.benchmarks.rod_case import ROPE, RodCase

DRAW_IN = 1.0  # s that the held end takes to its place
SAMPLE = 0.02  # s between two looks at the shape
AT_REST = (0.5, 1e-6)  # for so many s no point has moved farther than so many m
SETTLED = 1e-3  # m from the shape at rest, below which the rod counts as settled
TIME_LIMIT = 60.0  # s, simulated
CHUNK = 20  # steps in one call, where a library can do several


class TrialError(RuntimeError):
    """A library's simulation broke down."""


class RodModel(ABC):
    """A rod in a library whose steps damp the motion; see :class:`UndampedRodModel`.

    Attributes:
        time_step: simulated time of a step [s].
        free_length: length [m] from grip to grip, or from clamp to tip. A rod that is held in the
            middle of a segment begins there.
        overhang: length [m] of the stub beyond a grip.
        settings: a sentence on solver, iterations and the like.
    """

    time_step: float
    free_length: float
    overhang = 0.0
    settings: str

    @abstractmethod
    def advance(self, count: int) -> None:
        """Make a number of time steps; this is what is timed."""

    def advance_damped(self, count: int, factor: float) -> None:
        """Make a number of time steps, each of which keeps ``factor`` of all velocities."""
        self.advance(count)

    @abstractmethod
    def place_end(self, x: float, velocity: float) -> None:
        """Put the held last end at (x, 0, 0) [m] from the first, for the next step [m/s]."""

    @abstractmethod
    def points(self) -> np.ndarray:
        """Points (n, 2) of the centre line, x and z [m] from the first grip."""

    @abstractmethod
    def arc_lengths(self) -> np.ndarray:
        """Their arc lengths (n,) [m] from the first grip."""


class UndampedRodModel(RodModel):
    """A rod in a library that has no damping: it is added between the steps, and not timed."""

    def advance_damped(self, count: int, factor: float) -> None:
        for _ in range(count):
            self.advance(1)
            self.damp(factor)

    @abstractmethod
    def damp(self, factor: float) -> None:
        """Multiply all velocities by a factor."""


@dataclass(frozen=True)
class Trial:
    """What became of a rod in a library."""

    points: List[List[float]]  # at the end
    arc_lengths: List[float]
    free_length: float
    overhang: float
    time_step: float  # s
    settings: str
    settling_time: Optional[float]  # s, simulated; None: not at rest within the limit
    step_seconds: List[float] = field(default_factory=list)  # of the processor, per step


def run_trial(
    model: RodModel, case: RodCase, effort: Effort, time_limit: float = TIME_LIMIT
) -> Trial:
    """Let the rod come to rest and time its steps there. Raises TrialError."""
    settling_time = _settle(model, case, time_limit)
    points = _finite_points(model)
    timing = measure(lambda _: model.advance(CHUNK), effort=effort).per(CHUNK)
    return Trial(
        points=points.tolist(),
        arc_lengths=np.asarray(model.arc_lengths()).tolist(),
        free_length=model.free_length,
        overhang=model.overhang,
        time_step=model.time_step,
        settings=model.settings,
        settling_time=settling_time,
        step_seconds=list(timing.seconds),
    )


def _settle(model: RodModel, case: RodCase, time_limit: float) -> Optional[float]:
    """Simulate until the rod rests; the time [s] after which it stays next to its last shape."""
    factor = float(np.exp(-case.damping * model.time_step))
    stride = max(1, round(SAMPLE / model.time_step))
    window = max(1, round(AT_REST[0] / (stride * model.time_step)))
    recent = deque(maxlen=window + 1)
    history: List[Tuple[float, np.ndarray]] = []
    step = 0
    if case.load == ROPE:
        step = _draw_in(model, case, factor, history, stride)
    while step * model.time_step < time_limit:
        model.advance_damped(stride, factor)
        step += stride
        history.append((step * model.time_step, _finite_points(model)))
        recent.append(history[-1][1])
        if len(recent) > window and _distance(recent[0], recent[-1]) < AT_REST[1]:
            return _last_time_away(history)
    return None


def _draw_in(model: RodModel, case: RodCase, factor: float, history, stride: int) -> int:
    """Move the held end to its place at constant speed; returns the number of steps."""
    steps = round(DRAW_IN / model.time_step)
    way = model.free_length - case.span
    for step in range(1, steps + 1):
        model.place_end(model.free_length - way * step / steps, -way / (steps * model.time_step))
        model.advance_damped(1, factor)
        if step % stride == 0:
            history.append((step * model.time_step, _finite_points(model)))
    model.place_end(case.span, 0.0)
    return steps


def _finite_points(model: RodModel) -> np.ndarray:
    points = np.array(model.points(), dtype=float)
    if not np.isfinite(points).all():
        raise TrialError("the state is no longer finite")
    return points


def _distance(one: np.ndarray, other: np.ndarray) -> float:
    return float(np.linalg.norm(one - other, axis=1).max())


def _last_time_away(history: Sequence[Tuple[float, np.ndarray]]) -> float:
    final = history[-1][1]
    away = [time for time, points in history if _distance(points, final) > SETTLED]
    return away[-1] if away else 0.0
