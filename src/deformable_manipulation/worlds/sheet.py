"""A fabric that MuJoCo simulates."""

from typing import Sequence

import numpy as np

from deformable_manipulation.geometry.pose import Vector
from deformable_manipulation.objects.fabric import FabricSpec
from deformable_manipulation.scenario.agents import AgentSpec
from deformable_manipulation.scenario.grip_points import held_points
from deformable_manipulation.worlds.engine import load_engine, require_stable
from deformable_manipulation.worlds.flex_model import flex_xml

INTEGRATOR = "discrete"


class Sheet:
    """The fabric of a scenario as an elastic shell on the same mesh.

    Vertices are damped relative to the mean motion of the grips, at the rate ``object.damping``.

    Args:
        spec: the fabric, which ``check_world`` of the scenario allows.
        agents: AgentSpecs that hold it.
        gravity: (3,) [m/s^2].
        rest: ``_pbd.Body`` of the same fabric, whose shape it starts from.
        time_step: [s].

    Raises:
        WorldError: MuJoCo is missing.
    """

    def __init__(
        self, spec: FabricSpec, agents: Sequence[AgentSpec], gravity: Vector, rest, time_step: float
    ):
        compliances = spec.stretching_compliance, spec.bending_compliance
        self._engine = load_engine()
        particles = range(spec.particles)
        vertices = np.array([spec.particle_position(each) for each in particles])
        points = [held_points(spec, agent) for agent in agents]
        held = [particle for each in points for particle in each]
        places = np.array([place for each in points for place in each.values()])
        self._grips = np.repeat(np.arange(len(agents)), [len(each) for each in points])
        self._arms = places - np.array([agents[grip].start for grip in self._grips])
        xml = flex_xml(
            vertices,
            spec.faces(),
            spec.masses(),
            held,
            compliances,
            time_step,
            INTEGRATOR,
            gravity,
        )
        self._model = self._engine.MjModel.from_xml_string(xml)
        self._data = self._engine.MjData(self._model)
        self._bodies = np.array([self._model.body(f"v{i}").id for i in particles])
        self._held = self._bodies[held]
        self._keep = np.exp(-spec.damping * time_step)
        free = np.setdiff1d(particles, held)
        displaced = rest.positions() - vertices
        self._data.qpos[:] = displaced[free].ravel()
        self._model.body_pos[self._held] = places
        self._engine.mj_forward(self._model, self._data)

    def step(self, positions: np.ndarray, velocities: np.ndarray) -> None:
        """Advance by a time step, at whose end the grips are at (A, 3) [m].

        They move at ``velocities`` (A, 3) [m/s], and keep their orientations.
        """
        self._model.body_pos[self._held] = positions[self._grips] + self._arms
        self._engine.mj_step(self._model, self._data)
        carried = velocities.mean(axis=0)
        motion = self._data.qvel.reshape(-1, 3)
        motion[:] = carried + self._keep * (motion - carried)
        require_stable(self._data, self._data.time)

    def speed(self) -> float:
        """Of the fastest vertex [m/s]."""
        return float(np.linalg.norm(self._data.qvel.reshape(-1, 3), axis=1).max())

    def points(self) -> np.ndarray:
        """The vertices (V, 3) [m]."""
        self._engine.mj_kinematics(self._model, self._data)
        return self._data.xpos[self._bodies]
