"""A recorded run as arrays, the same whether read from a run folder or from a bag."""

from dataclasses import dataclass
from pathlib import Path
from typing import Mapping, Optional, Tuple

import numpy as np

from deformable_manipulation.objects.common import LARGEST_VALID_STRETCH
from deformable_manipulation.recording.timeseries import vector_columns


class RunDataError(Exception):
    """A run cannot be read; the message says what is missing or wrong and what to do."""


@dataclass(frozen=True)
class TurningSeries:
    """How the grip of an assistant turned, M samples."""

    nominal: np.ndarray  # (M, 3) rad/s
    command: np.ndarray  # (M, 3) rad/s


@dataclass(frozen=True)
class AssistantSeries:
    """What the controller of one assistant saw and decided, M samples; nan: unknown then."""

    agent: str
    time: np.ndarray  # (M,) s, 0 at cycle 0
    distance: np.ndarray  # (M,) m, of the object itself; inf: no obstacle
    error_norm: np.ndarray  # (M,) m
    h: Mapping[str, np.ndarray]  # (M,) the lowest of each barrier, by name, in its unit
    nominal_velocity: np.ndarray  # (M, 3) m/s
    command: np.ndarray  # (M, 3) m/s
    target: np.ndarray  # (M, 3) m, the place that it would keep
    status: np.ndarray  # (M,) int, the constants of ControllerState
    turning: Optional[TurningSeries] = None  # None: grips do not turn


@dataclass(frozen=True)
class RunData:
    """A run: the distance of the object itself over T cycles, and each assistant's series."""

    name: str  # of its folder or bag
    path: Path
    time: np.ndarray  # (T,) s, 0 at cycle 0
    distance: np.ndarray  # (T,) m, signed; inf: no obstacle
    offset: Optional[float]  # m, distance to keep; None: no controller has computed it
    assistants: Tuple[AssistantSeries, ...]
    max_stretch: Optional[float] = None  # largest relative change of length; None: not recorded
    valid_stretch: float = LARGEST_VALID_STRETCH  # of an object in use; beyond it nothing is valid
    notes: Tuple[str, ...] = ()  # notes on how it was read
    scenario: str = ""  # its name; empty: not recorded
    namespace: str = ""  # of its topics in a bag, such as /left

    @property
    def time_range(self) -> Tuple[float, float]:
        """From the first cycle to the end of the last one [s]; one second of a single cycle."""
        start, last = float(self.time[0]), float(self.time[-1])
        if last == start:
            return start, start + 1.0
        return start, round(last + (last - start) / (len(self.time) - 1), 6)


def make_assistant_series(
    agent: str, time: np.ndarray, distance: np.ndarray, columns: Mapping[str, np.ndarray]
) -> AssistantSeries:
    """Put together an assistant's series from arrays (M,) by their names in the time series."""
    status = columns["status"]
    if not np.all(np.isfinite(status)):
        raise RunDataError(f"the status of {agent} has values that are not numbers")
    return AssistantSeries(
        agent=agent,
        time=time,
        distance=distance,
        error_norm=columns["error_norm"],
        h={
            name[len(H_PREFIX) :]: values
            for name, values in columns.items()
            if name.startswith(H_PREFIX)
        },
        nominal_velocity=_stack(columns, "nominal_velocity"),
        command=_stack(columns, "command"),
        target=_stack(columns, "target"),
        status=status.astype(int),
        turning=_turning(columns),
    )


NOMINAL_TURNING, TURNING = "nominal_angular_velocity", "angular_velocity"
# Columns that only assistants have whose grips turn.
TURNING_SERIES_COLUMNS = vector_columns(NOMINAL_TURNING) + vector_columns(TURNING)
H_PREFIX = "h_"  # of the columns with the barriers' values

# Columns of an assistant in the time series that make_assistant_series needs, beside those.
SERIES_COLUMNS = (
    ("error_norm", "status")
    + vector_columns("nominal_velocity")
    + vector_columns("command")
    + vector_columns("target")
)


def _turning(columns: Mapping[str, np.ndarray]) -> Optional[TurningSeries]:
    """None without its columns, and where nothing is known in them."""
    if not all(name in columns for name in TURNING_SERIES_COLUMNS):
        return None
    nominal = _stack(columns, NOMINAL_TURNING)
    known = np.isfinite(nominal).any()
    return TurningSeries(nominal, _stack(columns, TURNING)) if known else None


def offset_of(assistants: Tuple[AssistantSeries, ...]) -> Optional[float]:
    """The collision offset [m] behind the recorded barrier values: distance - h."""
    differences = [
        series.distance - series.h["collision"] for series in assistants if "collision" in series.h
    ]
    values = np.concatenate(differences) if differences else np.empty(0)
    finite = values[np.isfinite(values)]
    return float(np.median(finite)) if finite.size else None


def _stack(columns: Mapping[str, np.ndarray], name: str) -> np.ndarray:
    return np.stack([columns[column] for column in vector_columns(name)], axis=-1)
