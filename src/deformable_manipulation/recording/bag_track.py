"""The messages of one topic of a bag as arrays, and which of them belong to the last run."""

from dataclasses import dataclass, replace
from operator import attrgetter
from typing import Any, Callable, Dict, Mapping, Optional, Sequence, Tuple

import numpy as np
from rosbags.rosbag1 import Reader
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from deformable_manipulation.recording.run_data import (
    H_PREFIX,
    SERIES_COLUMNS,
    TURNING_SERIES_COLUMNS,
    RunDataError,
)

CONTROLLER_STATE = "deformable_manipulation/msg/ControllerState"
DISTANCES = "deformable_manipulation/msg/Distances"

# The field of ControllerState that holds a column of the time series, where the names differ.
RENAMED = {"command_x": "velocity_x", "command_y": "velocity_y", "command_z": "velocity_z"}
CONTROLLER_COLUMNS = ("distance",) + SERIES_COLUMNS
# Barriers of recordings whose messages have no list of them.
_FIRST_BARRIERS = ("collision", "overstretch", "proximity")

_key = attrgetter("cycle", "reset_count", "header.stamp.sec", "header.stamp.nanosec")
_controller_values = attrgetter(*(RENAMED.get(name, name) for name in CONTROLLER_COLUMNS))


def _distance_values(message) -> Tuple[float]:
    """The distance of copy 0, the object itself."""
    minimum = message.minimum_distances
    return (minimum[0] if len(minimum) else float("nan"),)


def _barrier_values(message) -> Dict[str, float]:
    """The value of each barrier, by the name of its column; none of distances."""
    if hasattr(message, "barriers"):
        return {H_PREFIX + name: value for name, value in zip(message.barriers, message.h)}
    if hasattr(message, H_PREFIX + _FIRST_BARRIERS[0]):
        return {H_PREFIX + name: getattr(message, H_PREFIX + name) for name in _FIRST_BARRIERS}
    return {}


def _turning_values(message) -> Dict[str, float]:
    """How the grip turns, by columns; none of distances and of earlier versions."""
    return {
        name: getattr(message, name) for name in TURNING_SERIES_COLUMNS if hasattr(message, name)
    }


_EXTRACTORS: Dict[str, Tuple[Tuple[str, ...], Callable]] = {
    CONTROLLER_STATE: (CONTROLLER_COLUMNS, _controller_values),
    DISTANCES: (("distance",), _distance_values),
}


@dataclass(frozen=True)
class Track:
    """The M messages of one topic."""

    topic: str
    agent: str  # whose controller it is; empty for distances
    received: np.ndarray  # (M,) ns, when recorded
    cycle: np.ndarray  # (M,)
    reset_count: np.ndarray  # (M,)
    stamp: np.ndarray  # (M,) ns
    columns: Dict[str, np.ndarray]  # of (M,)

    def select(self, rows) -> "Track":
        """The same with some rows only (slice or mask)."""
        return replace(
            self,
            received=self.received[rows],
            cycle=self.cycle[rows],
            reset_count=self.reset_count[rows],
            stamp=self.stamp[rows],
            columns={name: values[rows] for name, values in self.columns.items()},
        )

    def last_run(self) -> Tuple["Track", int]:
        """The messages of the last run, each cycle once, and the number of runs.

        A run ends where the reset count changes (reset) or the cycle falls (restart).
        """
        change = (np.diff(self.reset_count) != 0) | (np.diff(self.cycle) < 0)
        starts = np.flatnonzero(change) + 1
        last = self.select(slice(starts[-1] if len(starts) else 0, None))
        # A latched message comes again to a recorder that connects again.
        fresh = np.concatenate(([True], np.diff(last.cycle) > 0))
        return last.select(fresh), len(starts) + 1


def read_track(reader: Reader, topic: str) -> Optional[Track]:
    """All messages of a topic of distances or controller states; None when there is none.

    Raises:
        RunDataError: recorded with message definitions that lack a needed field; and what rosbags
            raises on damaged data.
    """
    connections = [connection for connection in reader.connections if connection.topic == topic]
    msgtype = connections[0].msgtype
    typestore = get_typestore(Stores.ROS1_NOETIC)
    typestore.register(get_types_from_msg(connections[0].msgdef.data, msgtype))
    names, extract = _EXTRACTORS[msgtype]
    received, rows, others, agent = [], [], [], ""
    try:
        for _, time, data in reader.messages(connections):
            message: Any = typestore.deserialize_ros1(data, msgtype)
            received.append(time)
            rows.append(_key(message) + extract(message))
            others.append({**_barrier_values(message), **_turning_values(message)})
        if rows and msgtype == CONTROLLER_STATE:
            agent = message.agent
    except AttributeError as error:
        raise RunDataError(
            "{} was recorded with another version of {}: {}".format(
                topic, msgtype.replace("/msg/", "/"), error
            )
        ) from error
    if not rows:
        return None
    table = np.array(rows, dtype=float)
    return Track(
        topic=topic,
        agent=agent,
        received=np.array(received, dtype=np.int64),
        cycle=table[:, 0].astype(np.int64),
        reset_count=table[:, 1].astype(np.int64),
        stamp=table[:, 2].astype(np.int64) * 10**9 + table[:, 3].astype(np.int64),
        columns={
            **{name: table[:, 4 + index] for index, name in enumerate(names)},
            **_stacked(others),
        },
    )


def _stacked(rows: Sequence[Mapping[str, float]]) -> Dict[str, np.ndarray]:
    """Columns (M,) of all names in the rows; nan if a row lacks one."""
    names = dict.fromkeys(name for row in rows for name in row)
    return {name: np.array([row.get(name, np.nan) for row in rows]) for name in names}
