"""A true object that another engine simulates, carried by agents."""

import math
from typing import Union

import numpy as np

from deformable_manipulation.objects.fabric import FabricSpec
from deformable_manipulation.objects.rod import RodSpec
from deformable_manipulation.scenario.spec import Scenario
from deformable_manipulation.simulation.factory import make_simulation
from deformable_manipulation.worlds.cable import Cable
from deformable_manipulation.worlds.errors import WorldError
from deformable_manipulation.worlds.sheet import Sheet

LONGEST_STEP = 0.005  # s, at which the shape at rest is that of shorter ones
_AT_REST = 1e-3  # m/s
_PATIENCE = 20.0  # s


class EngineWorld:
    """Offers what is asked of a ``_pbd.Simulation`` without copies.

    Grips move at the commanded velocity within a cycle, and keep their orientations. The object
    starts from this package's shape at rest, and comes to rest in the engine.

    Args:
        scenario: with the true object.

    Raises:
        WorldError: the engine is missing or has no such object.
        RuntimeError: the engine's simulation broke down.
    """

    def __init__(self, scenario: Scenario):
        own = make_simulation(scenario, copies=False)
        self._cycle_time = scenario.cycle_time
        self._steps = math.ceil(self._cycle_time / LONGEST_STEP - 1e-9)
        self._step = self._cycle_time / self._steps
        self._object = _make_object(scenario, own.body, self._step)
        self._positions = np.array([agent.start for agent in scenario.agents])
        self._commands = np.zeros_like(self._positions)
        self._velocities = np.zeros_like(self._positions)
        self.cycle = 0
        self.rest = own.rest
        self.rest_warning = own.rest_warning
        self.softness = ""
        self.correction = None
        self._settle()

    @property
    def time(self) -> float:
        """Seconds since the start."""
        return self.cycle * self._cycle_time

    def set_command(self, agent: int, velocity, angular_velocity=(0.0, 0.0, 0.0)) -> None:
        """Velocity (3,) [m/s] of an agent from the next advance on; grips do not turn here."""
        self._commands[agent] = velocity

    def advance(self) -> None:
        """Advance by a cycle. Raises RuntimeError where the simulation breaks down."""
        self._velocities = self._commands.copy()
        begin = self._positions
        for step in range(1, self._steps + 1):
            place = begin + step * self._step * self._velocities
            self._object.step(place, self._velocities)
        self._positions = begin + self._cycle_time * self._velocities
        self.cycle += 1

    def positions(self) -> np.ndarray:
        """Held points (A, 3) [m]."""
        return self._positions.copy()

    def velocities(self) -> np.ndarray:
        """Velocities (A, 3) [m/s] that led to this state."""
        return self._velocities.copy()

    def points(self, out=None) -> np.ndarray:
        """Geometry points (1, P, 3) [m]; fills ``out`` if given."""
        points = self._object.points()[None]
        if out is None:
            return points
        out[:] = points
        return out

    def displaced_agents(self) -> np.ndarray:
        """There is the object itself alone (1,)."""
        return np.array([-1], dtype=np.int32)

    def displacements(self) -> np.ndarray:
        """None (1, 3)."""
        return np.zeros((1, 3))

    def ready(self) -> np.ndarray:
        """It is (1,)."""
        return np.ones(1, dtype=bool)

    def _settle(self) -> None:
        still = np.zeros_like(self._positions)
        for step in range(round(_PATIENCE / self._step)):
            self._object.step(self._positions, still)
            if step * self._step > 1.0 and self._object.speed() < _AT_REST:
                return
        self.rest = "moving"


def _make_object(scenario: Scenario, rest, time_step: float) -> Union[Cable, Sheet]:
    spec, agents, gravity = scenario.object, scenario.agents, scenario.simulation.gravity
    if isinstance(spec, RodSpec):
        return Cable(spec, agents, gravity, rest, time_step)
    if isinstance(spec, FabricSpec):
        return Sheet(spec, agents, gravity, rest, time_step)
    raise WorldError(f"knowledge.world: mujoco has no object of the type {spec.type}")
