"""Whether a run could have been answered by somebody who knows the leader's path beforehand."""

import dataclasses
from itertools import combinations
from typing import Any, Dict, Iterator, List, Optional, Tuple

import numpy as np
from scipy.optimize import linprog
from scipy.sparse import coo_matrix, vstack

from deformable_manipulation.motion.leader import LeaderPath
from deformable_manipulation.scenario import pair_limits
from deformable_manipulation.scenario.horizon import KNOWN
from deformable_manipulation.scenario.spec import Scenario

_STEP = 0.2  # s, between the times that are looked at
_ITERATIONS = 40
_PRECISION = 1e-4  # m, of the bound
# How far ahead a controller looks that knows the path; the first that keeps all limits is enough.
_FORESIGHTS: Tuple[Dict[str, Any], ...] = (
    {"length": 6.0, "nodes": 16},
    {"length": 10.0, "nodes": 20},
    {"length": 6.0, "nodes": 16, "weights": (1.0, 1.0, 1.0)},
)


def with_foresight(scenario: Scenario) -> Iterator[Scenario]:
    """The scenario with controllers that know the leader's path for many seconds ahead."""
    for foresight in _FORESIGHTS:
        horizon = dataclasses.replace(
            scenario.controller.horizon, leader=KNOWN, leader_doubt=0.0, **foresight
        )
        controller = dataclasses.replace(scenario.controller, horizon=horizon)
        yield dataclasses.replace(scenario, controller=controller)


def least_overstretch(scenario: Scenario) -> Optional[float]:
    """A lower bound of how far the maximum distances of two agents are exceeded by anybody [m].

    The smallest excess s of any motion of the assistants with ``norm(x_i - x_j) <= L_ij + s`` at
    times 0.2 s apart, whose steps between them are within the assistants' velocity. Obstacles,
    accelerations and what happens in between are left out, so that no controller can do better. It
    is a convex program: cutting planes of the distances, whose optimum comes nearer from below.

    Returns:
        None without a limit of stretch.
    """
    if scenario.controller.overstretch is None:
        return None
    return _Motion(scenario).least_excess()


class _Motion:
    """The assistants' positions at the times looked at, as variables of a linear program.

    The last variable is the excess.
    """

    def __init__(self, scenario: Scenario):
        path = LeaderPath(scenario.leader.waypoints)
        times = np.arange(0.0, scenario.simulation.duration + 1e-9, _STEP)
        self._starts = np.array([agent.start for agent in scenario.agents])
        self._leader = scenario.leader_index
        self._led = self._starts[self._leader] + path.position(times)
        self._count = len(times)
        self._columns = {agent: column for column, agent in enumerate(scenario.assistants)}
        self._size = 3 * len(self._columns) * self._count + 1
        self._reach = _STEP * scenario.controller.max_velocity
        self._limits = {
            pair: pair_limits(scenario, *pair).max_distance
            for pair in combinations(range(len(scenario.agents)), 2)
        }
        self._rows: List[coo_matrix] = [self._steps()]
        self._bounds = [np.full(self._rows[0].shape[0], self._reach)]

    def least_excess(self) -> float:
        """The bound [m]: each iteration's optimum is one."""
        excess, cost = 0.0, np.zeros(self._size)
        cost[-1] = 1.0
        positions = self._standing()
        for _ in range(_ITERATIONS):
            if not self._cut(positions, excess):
                break
            solution = linprog(
                cost,
                A_ub=vstack(self._rows).tocsr(),
                b_ub=np.concatenate(self._bounds),
                bounds=self._variable_bounds(),
                method="highs",
            )
            if not solution.success:
                break
            excess = max(excess, float(solution.x[-1]))
            positions = self._positions(solution.x)
        return excess

    def _variable_bounds(self):
        bounds = np.full((self._size, 2), [-np.inf, np.inf])
        for agent, column in self._columns.items():
            first = 3 * self._count * column
            bounds[first : first + 3] = self._starts[agent][:, None]
        bounds[-1] = 0.0, np.inf
        return bounds

    def _index(self, agent, time):
        return 3 * (self._count * self._columns[agent] + time)

    def _steps(self):
        """Rows x[t + 1] - x[t] and the opposite, of every component."""
        values, rows, columns, row = [], [], [], 0
        for agent in self._columns:
            for time in range(self._count - 1):
                here, there = self._index(agent, time), self._index(agent, time + 1)
                for axis in range(3):
                    for sign in (1.0, -1.0):
                        values += [sign, -sign]
                        rows += [row, row]
                        columns += [there + axis, here + axis]
                        row += 1
        return coo_matrix((values, (rows, columns)), shape=(row, self._size))

    def _standing(self):
        """Positions (agents, times, 3) of assistants that stay at their starts."""
        positions = np.repeat(self._starts[:, None], self._count, axis=1)
        positions[self._leader] = self._led
        return positions

    def _positions(self, solution):
        positions = np.empty((len(self._starts), self._count, 3))
        positions[self._leader] = self._led
        for agent, column in self._columns.items():
            first = 3 * self._count * column
            positions[agent] = solution[first : first + 3 * self._count].reshape(-1, 3)
        return positions

    def _cut(self, positions, excess):
        """Cut off positions that are too far apart; False where there are none."""
        values, rows, columns, bounds = [], [], [], []
        for (i, j), limit in self._limits.items():
            between = positions[i] - positions[j]
            lengths = np.linalg.norm(between, axis=1)
            for time in np.flatnonzero(lengths > limit + excess + _PRECISION):
                direction = between[time] / lengths[time]
                bound = limit
                for agent, sign in ((i, 1.0), (j, -1.0)):
                    if agent == self._leader:
                        bound -= sign * float(direction @ self._led[time])
                        continue
                    first = self._index(agent, time)
                    values += (sign * direction).tolist()
                    columns += [first, first + 1, first + 2]
                    rows += [len(bounds)] * 3
                values.append(-1.0)
                columns.append(self._size - 1)
                rows.append(len(bounds))
                bounds.append(bound)
        if not bounds:
            return False
        self._rows.append(coo_matrix((values, (rows, columns)), shape=(len(bounds), self._size)))
        self._bounds.append(np.array(bounds))
        return True
