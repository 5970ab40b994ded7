"""The outcome of one run, in the numbers that a campaign counts."""

import dataclasses
import math
from dataclasses import dataclass
from typing import Dict, Mapping, Optional

import numpy as np
from scipy.signal import butter, sosfiltfilt

from deformable_manipulation.control.status import Status
from deformable_manipulation.obstacles.spec import are_as_known
from deformable_manipulation.recording.timeseries import TimeSeries, vector_columns
from deformable_manipulation.scenario.barriers import BARRIERS
from deformable_manipulation.scenario.spec import Scenario
from deformable_manipulation.simulation.stretch import largest_stretch

REST_SPEED = 1e-3  # m/s, a leader slower than this is at rest
DEADLOCK_ERROR = 0.05  # m
DEADLOCK_TIME = 3.0  # s
OSCILLATION_FREQUENCY = 1.0  # Hz
_FILTER_ORDER = 4
_ROUNDING = 1e-9

# Whether a run could be answered: it was; nobody could; one who knows the path could; not known.
KEPT, IMPOSSIBLE, POSSIBLE, UNKNOWN = "kept", "impossible", "possible", "unknown"
_SHORTEST_STRETCH = 2.0  # s, of constrained motion: less has nothing to say about 1 Hz
_MOST_WAITING = 0.5  # of a run: one with more says nothing about the assistant
_RECOVERY = 10.0  # s, after which an assistant that was constrained has come back to its place


@dataclass(frozen=True)
class RunOutcome:
    """The numbers of one run of a campaign. A violation is how far a limit was missed at worst."""

    index: int  # of the run in its campaign
    completed: bool  # False: the simulation broke down; then only what was until then counts
    problem: str  # why it was not completed, or empty
    min_distance: float  # m; inf: no obstacle
    violations: Mapping[str, float]  # of each barrier, by name, in its unit
    deadlock: bool  # an assistant stays away from its place though nothing is in the way
    stuck: bool  # an assistant stays away from its place, whatever is in the way
    relaxed: int  # quadratic programs
    failed: int
    oscillation: float  # m RMS, of the distance above 1 Hz while an assistant is constrained
    tracking_error: float  # m, largest of all assistants when none was constrained for 10 s
    final_error: float  # m, largest of all assistants
    constrained: float  # share of the run in which an assistant is constrained
    shape_error: float  # largest relative change of the object's length
    path: str = ""  # kind of the leader's path
    speed: float = math.nan  # m/s, that no component of the leader's velocity exceeds
    leader: str = ""  # what the controllers expect of it
    answer: str = ""  # what somebody could have done who knows the path: KEPT, IMPOSSIBLE ...
    least_overstretch: float = 0.0  # m, by which anybody must exceed the limits of stretch
    waiting: float = 0.0  # share of the run in which an assistant waited, the largest of all

    @property
    def waits(self) -> bool:
        """Whether an assistant waited for most of the run, such as for a camera."""
        return self.waiting > _MOST_WAITING

    def misses(self, tolerance: float) -> bool:
        """Whether a limit was missed, lengths by more than the tolerance [m], or it broke down."""
        return not self.completed or any(
            each > tolerance_of(name, tolerance) for name, each in self.violations.items()
        )

    def to_mapping(self) -> Dict[str, object]:
        """All fields by name, the violations as ``violation_NAME``."""
        mapping = dataclasses.asdict(self)
        for name, violation in mapping.pop("violations").items():
            mapping[f"violation_{name}"] = violation
        return mapping


def tolerance_of(barrier: str, tolerance: float) -> float:
    """Up to where a violation does not count: of loads, which keep a reserve, rounding alone.

    Args:
        barrier: its name.
        tolerance: [m], of lengths.
    """
    return _ROUNDING if BARRIERS[barrier].is_load else tolerance


def assess(
    scenario: Scenario, series: TimeSeries, index: int = 0, problem: Optional[str] = None
) -> RunOutcome:
    """The :class:`RunOutcome` of a recorded run.

    Args:
        problem: why the run ended before its time, None for a whole one.
    """
    distance = series.column("distance")
    status = _of_assistants(series, "status")
    error = _of_assistants(series, "error_norm")
    constrained = np.isin(status, (Status.CONSTRAINED, Status.RELAXED)).any(axis=0)
    rate = scenario.controller.rate
    lowest = float(distance.min(initial=np.inf))
    away = _stays_away(scenario, series, error)
    return RunOutcome(
        index=index,
        completed=problem is None,
        problem=problem or "",
        min_distance=lowest,
        violations={
            name: _below_zero(_true_margins(scenario, series, name)) for name in series.barriers
        },
        deadlock=away and _is_free(scenario, distance),
        stuck=away,
        relaxed=int(np.count_nonzero(status == Status.RELAXED)),
        failed=int(np.count_nonzero(status == Status.FAILED)),
        oscillation=oscillation(distance, constrained, rate),
        tracking_error=_largest(error[:, _undisturbed(constrained, rate)]),
        final_error=_largest(error[:, -1:]),
        constrained=float(constrained.mean()) if constrained.size else 0.0,
        shape_error=largest_stretch(series.column("stretch")) or 0.0,
        waiting=float((status == Status.WAITING).mean(axis=1).max()) if status.size else 0.0,
    )


def oscillation(values: np.ndarray, where: np.ndarray, rate: float) -> float:
    """Root mean square of what moves faster than 1 Hz, over the samples chosen.

    Each unbroken stretch of chosen samples is filtered by itself, forwards and backwards
    (Butterworth, of fourth order), so that what happens outside does not leak in.

    Args:
        values: (N,) samples.
        where: (N,) which of them count.
        rate: [Hz].
    """
    shortest = int(_SHORTEST_STRETCH * rate)
    if rate <= 2.0 * OSCILLATION_FREQUENCY:
        return 0.0
    high_pass = butter(_FILTER_ORDER, OSCILLATION_FREQUENCY, "highpass", fs=rate, output="sos")
    usable = where & np.isfinite(values)
    edges = np.flatnonzero(np.diff(np.concatenate(([False], usable, [False])).astype(int)))
    square, count = 0.0, 0
    for begin, end in zip(edges[::2], edges[1::2]):
        if end - begin >= shortest:
            fast = sosfiltfilt(high_pass, values[begin:end])
            square += float(fast @ fast)
            count += end - begin
    return float(np.sqrt(square / count)) if count else 0.0


def _undisturbed(constrained: np.ndarray, rate: float) -> np.ndarray:
    """Samples (N,) that come at least the time of recovery after the last constrained one."""
    samples = np.arange(len(constrained))
    last = np.maximum.accumulate(np.where(constrained, samples, -len(samples) - 1))
    return (samples - last > _RECOVERY * rate) | (last < 0)


def _last_rows(scenario) -> int:
    return int(DEADLOCK_TIME * scenario.controller.rate)


def _largest(errors: np.ndarray) -> float:
    """Of errors [m]; nan: an assistant knew nothing of its state yet."""
    return float(np.nanmax(errors, initial=0.0))


def _stays_away(scenario, series, error) -> bool:
    """Whether an error stays above 5 cm for the last 3 s with the leader at rest."""
    last = _last_rows(scenario)
    if not 0 < last <= len(series):
        return False
    leader = scenario.agents[scenario.leader_index].name
    velocity = np.column_stack(
        [series.column(f"{leader}.{name}") for name in vector_columns("velocity")]
    )
    at_rest = np.linalg.norm(velocity[-last:], axis=1).max() < REST_SPEED
    return bool(at_rest and (error[:, -last:].min(axis=1) > DEADLOCK_ERROR).any())


def _is_free(scenario, distance) -> bool:
    """Whether nothing is near the object for the last 3 s."""
    collision = scenario.controller.collision
    lowest = distance[-_last_rows(scenario) :].min()
    return bool(lowest > collision.offset + collision.band)


def _true_margins(scenario, series: TimeSeries, barrier: str) -> np.ndarray:
    """h [m] of a barrier: as the controllers know it, or of the true distance if they do not."""
    if barrier == "collision" and not are_as_known(scenario.obstacles):
        return series.column("distance") - scenario.controller.collision.offset
    return _of_assistants(series, f"h_{barrier}")


def _below_zero(margins: np.ndarray) -> float:
    """How far the lowest of all margins that are known is below zero."""
    return max(0.0, -float(np.nanmin(margins, initial=np.inf)))


def _of_assistants(series: TimeSeries, column: str) -> np.ndarray:
    """A column of every assistant (assistants, rows)."""
    return np.array([series.column(f"{name}.{column}") for name in series.assistants])
