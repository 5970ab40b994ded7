"""One object in one library: drawn in, left to come to rest, timed. The same for every library.

Runs in the interpreter of the library: nothing but numpy is needed.
"""

from abc import ABC, abstractmethod
from collections import deque
from dataclasses import dataclass, field
from typing import Any, Dict, List, Optional, Sequence, Tuple

import numpy as np

from deformable_manipulation.benchmarks.harness import Effort, measure

DRAW_IN = 1.0  # s that held points take to their places
SAMPLE = 0.02  # s between two looks at the shape
AT_REST = (0.5, 1e-6)  # for so many s no point has moved farther than so many m
SETTLED = 1e-3  # m from the shape at rest, below which the object counts as settled
TIME_LIMIT = 60.0  # s, simulated
CHUNK = 20  # steps in one call, where a library can do several


class TrialError(RuntimeError):
    """A library's simulation broke down."""


class Model(ABC):
    """An object in a library whose steps damp the motion; see :class:`UndampedModel`.

    Attributes:
        time_step: simulated time of a step [s].
        settings: a sentence on solver, iterations and the like.
    """

    time_step: float
    settings: str

    @abstractmethod
    def advance(self, count: int) -> None:
        """Make a number of time steps; this is what is timed."""

    def advance_damped(self, count: int, factor: float) -> None:
        """Make a number of time steps, each of which keeps ``factor`` of all velocities."""
        self.advance(count)

    @abstractmethod
    def points(self) -> np.ndarray:
        """Points (n, 2 or 3) [m] of the object."""

    def measures(self) -> Dict[str, Any]:
        """What else the error depends on; plain numbers and lists."""
        return {}


class UndampedModel(Model):
    """An object in a library that has no damping: it is added between the steps, and not timed."""

    def advance_damped(self, count: int, factor: float) -> None:
        for _ in range(count):
            self.advance(1)
            self.damp(factor)

    @abstractmethod
    def damp(self, factor: float) -> None:
        """Multiply all velocities by a factor."""


class Case(ABC):
    """What all libraries simulate; a dataclass of plain numbers and lists.

    Attributes:
        damping: of all motion [1/s], forces of -damping x mass x velocity.
        drawn_in: whether held points move to their places at first.
    """

    damping: float
    drawn_in: bool

    @abstractmethod
    def draw_in(self, model: Model, progress: float, rate: float) -> None:
        """Put held points where the next step ends: at progress 0 to 1 of their way; rate [1/s]."""


@dataclass(frozen=True)
class Trial:
    """What became of an object in a library."""

    points: List[List[float]]  # at the end
    time_step: float  # s
    settings: str
    settling_time: Optional[float]  # s, simulated; None: not at rest within the limit
    step_seconds: List[float] = field(default_factory=list)  # of the processor, per step
    measures: Dict[str, Any] = field(default_factory=dict)  # what the model adds to its points


def run_trial(model: Model, case: Case, effort: Effort, time_limit: float = TIME_LIMIT) -> Trial:
    """Let the object come to rest and time its steps there. Raises TrialError."""
    settling_time = _settle(model, case, time_limit)
    points = _finite_points(model)
    timing = measure(lambda _: model.advance(CHUNK), effort=effort).per(CHUNK)
    return Trial(
        points=points.tolist(),
        time_step=model.time_step,
        settings=model.settings,
        settling_time=settling_time,
        step_seconds=list(timing.seconds),
        measures=model.measures(),
    )


def _settle(model: Model, case: Case, time_limit: float) -> Optional[float]:
    """Simulate until the object rests; the time [s] after which it stays next to its last shape."""
    factor = float(np.exp(-case.damping * model.time_step))
    stride = max(1, round(SAMPLE / model.time_step))
    window = max(1, round(AT_REST[0] / (stride * model.time_step)))
    recent = deque(maxlen=window + 1)
    history: List[Tuple[float, np.ndarray]] = []
    step = 0
    if case.drawn_in:
        step = _draw_in(model, case, factor, history, stride)
    while step * model.time_step < time_limit:
        model.advance_damped(stride, factor)
        step += stride
        history.append((step * model.time_step, _finite_points(model)))
        recent.append(history[-1][1])
        if len(recent) > window and _distance(recent[0], recent[-1]) < AT_REST[1]:
            return _last_time_away(history)
    return None


def _draw_in(model: Model, case: Case, factor: float, history, stride: int) -> int:
    """Move held points to their places at constant speed; returns the number of steps."""
    steps = round(DRAW_IN / model.time_step)
    for step in range(1, steps + 1):
        case.draw_in(model, step / steps, 1.0 / (steps * model.time_step))
        model.advance_damped(1, factor)
        if step % stride == 0:
            history.append((step * model.time_step, _finite_points(model)))
    case.draw_in(model, 1.0, 0.0)
    return steps


def _finite_points(model: Model) -> np.ndarray:
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
