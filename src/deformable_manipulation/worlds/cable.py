"""A rope or rod that MuJoCo simulates."""

from typing import Sequence

import numpy as np

from deformable_manipulation.geometry.pose import Vector
from deformable_manipulation.objects.rod import RodSpec
from deformable_manipulation.scenario.agents import AgentSpec
from deformable_manipulation.worlds.cable_model import HOLD_STEPS, cable_xml, piece_name
from deformable_manipulation.worlds.engine import load_engine, require_stable


class Cable:
    """The rod of a scenario as a cable of one piece per segment.

    Pieces are damped relative to the motion between their grips, at the rate ``object.damping``, as
    those of this package are. The viscosity of bending counts for twist, too.

    Args:
        spec: the rod, which ``check_world`` of the scenario allows.
        agents: AgentSpecs that hold it.
        gravity: (3,) [m/s^2].
        rest: ``_pbd.Body`` of the same rod, whose shape it starts from.
        time_step: [s].

    Raises:
        WorldError: MuJoCo is missing.
    """

    def __init__(
        self, spec: RodSpec, agents: Sequence[AgentSpec], gravity: Vector, rest, time_step: float
    ):
        self._engine = load_engine()
        xml = cable_xml(spec, agents, gravity, time_step)
        self._model = self._engine.MjModel.from_xml_string(xml)
        self._data = self._engine.MjData(self._model)
        names = (piece_name(piece, spec.segments) for piece in range(spec.segments))
        self._pieces = np.array([self._model.body(name).id for name in names])
        self._masses = self._model.body_mass[self._pieces, None]
        self._piece_length = spec.length / spec.segments
        self._damping = spec.damping
        # Of a critically damped hold, twice its time constant; the step that begins is in it.
        self._lag = 2.0 * HOLD_STEPS * time_step - time_step
        held = np.array([agent.particle for agent in agents])
        order = np.argsort(held)
        # Weights of the grips in the motion that a piece is damped relative to.
        self._carried = np.zeros((spec.segments, len(held)))
        for agent, unit in zip(order, np.eye(len(held))):
            self._carried[:, agent] = np.interp(np.arange(spec.segments), held[order], unit)
        self._begin(rest, agents)

    def _begin(self, rest, agents: Sequence[AgentSpec]) -> None:
        orientations = rest.orientations()[:, [3, 0, 1, 2]]  # MuJoCo has w first
        before = orientations[:-1] * (1.0, -1.0, -1.0, -1.0)
        joints = np.array([_product(a, b) for a, b in zip(before, orientations[1:])])
        along = rest.points()[0, 1] - rest.points()[0, 0]
        self._data.qpos[:3] = rest.positions()[0] - 0.5 * along
        self._data.qpos[3:7] = orientations[0]
        self._data.qpos[7:] = joints.ravel()
        for number, agent in enumerate(agents):
            x, y, z, w = agent.orientation
            self._data.mocap_quat[number] = (w, x, y, z)
        self._data.mocap_pos[:] = [agent.start for agent in agents]
        self._engine.mj_forward(self._model, self._data)

    def step(self, positions: np.ndarray, velocities: np.ndarray) -> None:
        """Advance by a time step, at whose end the grips are at (A, 3) [m], moving at (A, 3) [m/s].

        Held pieces follow their grips with a lag, which is made up for: the engine knows no
        velocity of the grips.
        """
        self._data.mocap_pos[:] = positions + self._lag * velocities
        relative = self._velocities() - self._carried @ velocities
        self._data.xfrc_applied[self._pieces, :3] = -self._damping * self._masses * relative
        self._engine.mj_step(self._model, self._data)
        require_stable(self._data, self._data.time)

    def speed(self) -> float:
        """Of the fastest piece [m/s]."""
        return float(np.linalg.norm(self._velocities(), axis=1).max())

    def points(self) -> np.ndarray:
        """The pieces' ends (N + 1, 3) [m]."""
        self._engine.mj_kinematics(self._model, self._data)
        starts = self._data.xpos[self._pieces]
        along = self._data.xmat[self._pieces[-1]].reshape(3, 3)[:, 0]
        return np.vstack((starts, starts[-1] + self._piece_length * along))

    def _velocities(self) -> np.ndarray:
        """Of the pieces' centres (N, 3) [m/s]; the engine tells those at the centre of the tree."""
        twists = self._data.cvel[self._pieces]
        arms = self._data.xipos[self._pieces] - self._data.subtree_com[self._pieces[0]]
        return twists[:, 3:] + np.cross(twists[:, :3], arms)


def _product(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Of two quaternions, w first."""
    vector = a[0] * b[1:] + b[0] * a[1:] + np.cross(a[1:], b[1:])
    return np.concatenate(([a[0] * b[0] - a[1:] @ b[1:]], vector))
