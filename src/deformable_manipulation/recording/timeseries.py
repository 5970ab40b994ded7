"""The table of a run: one row per cycle, with the columns of ``timeseries.csv``."""

import math
from dataclasses import dataclass
from typing import IO, List, Mapping, NamedTuple, Optional, Sequence, Tuple

import numpy as np

from deformable_manipulation.control.decision import Decision
from deformable_manipulation.scenario.spec import Scenario

AXES = ("x", "y", "z")
INITIAL_ROWS = 1 << 14


def vector_columns(name: str) -> Tuple[str, ...]:
    """Names of the three columns of a vector."""
    return tuple(f"{name}_{axis}" for axis in AXES)


RUN_COLUMNS = ("cycle", "time", "distance", "stretch")
# Of runs whose controllers see a model of the object.
MODEL_COLUMNS = ("model_distance", "correction", "disagrees")
AGENT_COLUMNS = vector_columns("position") + vector_columns("velocity")
# Kept beside the columns of the file: they describe the machine, not the run.
TIMING_COLUMNS = ("simulation", "distance", "controller")


# Of assistants whose grips turn.
TURNING_COLUMNS = (
    vector_columns("orientation_error")
    + vector_columns("nominal_angular_velocity")
    + vector_columns("angular_velocity")
)


def assistant_columns(barriers: Sequence[str], turns: bool = False) -> Tuple[str, ...]:
    """Names of an assistant's columns, for the barriers in use.

    Args:
        barriers: their names.
        turns: whether the grips turn.
    """
    return (
        vector_columns("target")
        + vector_columns("error")
        + ("error_norm",)
        + vector_columns("nominal_velocity")
        + vector_columns("command")
        + tuple(f"h_{name}" for name in barriers)
        + vector_columns("jacobian")
        + ("exact_jacobian", "leader_drift")
        + tuple(f"slack_{name}" for name in barriers)
        + ("status", "rows", "solve_time")
        + (TURNING_COLUMNS if turns else ())
    )


class CycleTimings(NamedTuple):
    """Seconds that the parts of one cycle took; nan: did not run in this cycle."""

    simulation: float
    distance: float
    controller: float


class ModelRecord(NamedTuple):
    """What the controllers saw in place of the object itself."""

    distance: float  # m, signed minimum; inf: no obstacle
    points: np.ndarray  # (P, 3) m
    correction: float = 0.0  # m, by which measured points have moved it, where that is largest
    disagrees: bool = False  # whether it disagrees with them


@dataclass(frozen=True)
class CycleRecord:
    """Everything worth keeping of one cycle: A agents, P geometry points of the object itself.

    The arrays are copied when recorded, so the caller may use them again. ``decisions`` holds the
    :class:`~deformable_manipulation.control.decision.Decision` of every assistant by name.
    """

    cycle: int
    time: float  # s
    distance: float  # m, signed minimum of the object itself; inf: no obstacle
    stretch: float  # relative change of length of the object itself, where that is largest
    positions: np.ndarray  # (A, 3) m, held points
    velocities: np.ndarray  # (A, 3) m/s, the velocities that led to this state
    points: np.ndarray  # (P, 3) m
    obstacles: np.ndarray  # (K, 7) m, quaternion: poses of the K moving obstacles
    decisions: Mapping[str, Decision]
    timings: CycleTimings
    model: Optional[ModelRecord] = None  # None: the controllers see the object itself


class TimeSeries:
    """Rows of a run in memory: appended in some microseconds, written as CSV at the end."""

    @classmethod
    def of(cls, scenario: Scenario) -> "TimeSeries":
        """An empty table for a run of a scenario."""
        names = tuple(agent.name for agent in scenario.agents)
        assistants = tuple(names[index] for index in scenario.assistants)
        return cls(
            names,
            assistants,
            scenario.controller.barriers,
            rows=scenario.cycles,
            turns=scenario.controller.turns,
            modelled=not scenario.knowledge.sees_object,
        )

    def __init__(
        self,
        agents: Tuple[str, ...],
        assistants: Tuple[str, ...],
        barriers: Tuple[str, ...],
        rows: int = 0,
        turns: bool = False,
        modelled: bool = False,
    ):
        """An empty table.

        Args:
            agents: in the order of the arrays of a CycleRecord.
            assistants: those of them that decide.
            barriers: in use, by name.
            rows: expected.
            turns: whether grips turn.
            modelled: whether the records have a ``model``.
        """
        self._turns = turns
        self.assistants = assistants
        self.barriers = barriers
        self.modelled = modelled
        self.columns = RUN_COLUMNS + (MODEL_COLUMNS if modelled else ())
        self.columns += tuple(f"{agent}.{column}" for agent in agents for column in AGENT_COLUMNS)
        self.columns += tuple(
            f"{assistant}.{name}"
            for assistant in assistants
            for name in assistant_columns(barriers, turns)
        )
        self._indices = {name: index for index, name in enumerate(self.columns)}
        self._count = 0
        self._rows = np.empty((0, len(self.columns) + len(TIMING_COLUMNS)))
        self._allocate(min(max(rows, 1), INITIAL_ROWS))

    def __len__(self) -> int:
        return self._count

    def append(self, record: CycleRecord) -> None:
        """Add the row of one cycle; KeyError where an assistant's decision is missing."""
        count = self._count
        if count == len(self._rows):
            self._allocate(2 * count)
        # One list and one assignment: many small assignments to an array cost twice as much.
        row = [record.cycle, record.time, record.distance, record.stretch]
        if self.modelled:
            model = record.model
            row += [model.distance, model.correction, model.disagrees] if model else 3 * [math.nan]
        for position, velocity in zip(record.positions.tolist(), record.velocities.tolist()):
            row += position
            row += velocity
        for name in self.assistants:
            row += self._decision_row(record.decisions[name])
        row += record.timings
        self._rows[count] = row
        # Last, so that an interruption within this function leaves whole rows only.
        self._count = count + 1

    def column(self, name: str) -> np.ndarray:
        """One column by its name in the file, shape (rows,)."""
        return self._rows[: self._count, self._indices[name]]

    def timing(self, name: str) -> np.ndarray:
        """Seconds per cycle of one of TIMING_COLUMNS, shape (rows,)."""
        return self._rows[: self._count, len(self.columns) + TIMING_COLUMNS.index(name)]

    def write_csv(self, file: IO) -> None:
        """Write all rows, with twelve significant digits, to an open text file."""
        file.write(",".join(self.columns) + "\n")
        row_format = ",".join(["%.12g"] * len(self.columns)) + "\n"
        rows = self._rows[: self._count, : len(self.columns)]
        file.writelines(row_format % tuple(row) for row in rows.tolist())

    def _decision_row(self, decision: Decision) -> List[float]:
        """An assistant's decision in the order of assistant_columns()."""
        error_x, error_y, error_z = decision.error.tolist()
        return [
            *decision.target.tolist(),
            error_x,
            error_y,
            error_z,
            math.sqrt(error_x * error_x + error_y * error_y + error_z * error_z),
            *decision.nominal.tolist(),
            *decision.command.tolist(),
            *(decision.h.get(name, math.nan) for name in self.barriers),
            *decision.jacobian.tolist(),
            decision.exact_jacobian,
            decision.leader_drift,
            *(decision.slack.get(name, 0.0) for name in self.barriers),
            decision.status,
            decision.rows,
            decision.solve_time,
            *(self._turning_row(decision) if self._turns else ()),
        ]

    @staticmethod
    def _turning_row(decision: Decision) -> List[float]:
        """The same in the order of TURNING_COLUMNS."""
        return [
            *decision.orientation_error.tolist(),
            *decision.angular_nominal.tolist(),
            *decision.angular_command.tolist(),
        ]

    def _allocate(self, rows: int) -> None:
        table = np.empty((rows, len(self.columns) + len(TIMING_COLUMNS)))
        table[: self._count] = self._rows[: self._count]
        self._rows = table
