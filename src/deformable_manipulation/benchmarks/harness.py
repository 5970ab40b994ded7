"""Timing of short operations: medians and minima over repetitions, free of the package's parts."""

import contextlib
import gc
import math
import time
from dataclasses import dataclass
from typing import Any, Callable, Iterable, Iterator, List, Sequence

Clock = Callable[[], float]  # seconds from any start, never backwards


@dataclass(frozen=True)
class Effort:
    """How much is measured."""

    repetitions: int = 21
    least_time: float = 0.01  # s of one repetition, far above what reading the clock takes

    def __post_init__(self):
        if self.repetitions < 1 or not 0.0 < self.least_time < math.inf:
            raise ValueError(
                f"repetitions {self.repetitions}, least_time {self.least_time}: there must be at "
                "least one repetition and a positive time [s]"
            )


FULL = Effort()
QUICK = Effort(repetitions=3, least_time=5e-4)


@dataclass(frozen=True)
class Timing:
    """Seconds that one operation took, in each of the repetitions."""

    seconds: Sequence[float]
    inner: int = 1  # operations per repetition

    @property
    def median(self) -> float:
        return self.quantile(0.5)

    @property
    def minimum(self) -> float:
        return min(self.seconds)

    def quantile(self, fraction: float) -> float:
        """The value [s] below which a fraction of the repetitions lies, between neighbours linear.

        Raises:
            ValueError: the fraction is not within 0 and 1.
        """
        if not 0.0 <= fraction <= 1.0:
            raise ValueError(f"fraction: {fraction} must be from 0 to 1")
        ordered = sorted(self.seconds)
        place = fraction * (len(ordered) - 1)
        below = int(place)
        above = min(below + 1, len(ordered) - 1)
        return ordered[below] + (place - below) * (ordered[above] - ordered[below])

    def per(self, parts: int) -> "Timing":
        """The timing of one of the equal parts that the operation consists of."""
        return Timing([value / parts for value in self.seconds], self.inner * parts)


def _no_state() -> None:
    return None


def measure(
    operation: Callable[[Any], Any],
    prepare: Callable[[], Any] = _no_state,
    effort: Effort = FULL,
    clock: Clock = time.perf_counter,
) -> Timing:
    """Time an operation, as often in a row as makes up the least time of a repetition.

    Before each repetition, outside of the measured time, ``prepare`` makes the state that the
    operation is called with: every repetition does the same work. Finding out how often also warms
    up caches, branch prediction and the processor's clock.
    """
    inner = _inner_loops(operation, prepare, effort.least_time, clock)
    seconds = [_once(operation, prepare(), inner, clock) / inner for _ in range(effort.repetitions)]
    return Timing(seconds, inner)


def measure_each(
    operations: Iterable[Callable[[], Any]], rounds: int, clock: Clock = time.perf_counter
) -> Timing:
    """Time every single call, for the tail of the distribution; one more round warms up."""
    calls = list(operations)
    seconds: List[float] = []
    for call in calls:
        call()
    with no_garbage_collection():
        for _ in range(rounds):
            for call in calls:
                start = clock()
                call()
                seconds.append(clock() - start)
    return Timing(seconds)


def _inner_loops(operation, prepare, least_time: float, clock: Clock) -> int:
    inner = 1
    while True:
        elapsed = _once(operation, prepare(), inner, clock)
        if elapsed >= least_time:
            return inner
        # Not straight to the goal: the first runs are slower than those to come.
        growth = 1.2 * least_time / elapsed if elapsed > 0.0 else 10.0
        inner = max(inner + 1, int(inner * min(growth, 10.0)))


def _once(operation, state, inner: int, clock: Clock) -> float:
    loop = range(inner)
    with no_garbage_collection():
        start = clock()
        for _ in loop:
            operation(state)
        return clock() - start


@contextlib.contextmanager
def no_garbage_collection() -> Iterator[None]:
    """The collector would run at some time in some repetition."""
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()
