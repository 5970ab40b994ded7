"""The cloth in MuJoCo: a flex of two dimensions, an elastic shell of finite elements."""

import mujoco
import numpy as np

from deformable_manipulation.benchmarks.fabric_case import (
    FabricCase,
    FabricModel,
    UndampedFabricModel,
)
from deformable_manipulation.benchmarks.rivals.mujoco_warnings import require_stable
from deformable_manipulation.worlds.flex_model import flex_xml


def make(case: FabricCase, integrator: str, step_us: int) -> FabricModel:
    """The cloth of a case, in time steps of so many microseconds."""
    return MujocoFabric(case, integrator, 1e-6 * step_us)


class MujocoFabric(UndampedFabricModel):
    """The material that is as stiff as the case's along the edges and against bending."""

    def __init__(self, case: FabricCase, integrator: str, time_step: float):
        self.time_step = time_step
        self.settings = f"flex, {integrator}"
        xml = flex_xml(
            np.array(case.vertices),
            np.array(case.triangles),
            case.masses,
            case.held,
            (case.stretching_compliance, case.bending_compliance),
            time_step,
            integrator,
            (0.0, 0.0, -case.gravity),
        )
        self._model = mujoco.MjModel.from_xml_string(xml)
        self._data = mujoco.MjData(self._model)
        self._bodies = np.array([self._model.body(f"v{i}").id for i in range(len(case.vertices))])
        self._held = self._bodies[case.held]

    def advance(self, count: int) -> None:
        mujoco.mj_step(self._model, self._data, nstep=count)

    def damp(self, factor: float) -> None:
        self._data.qvel *= factor

    def place_held(self, positions: np.ndarray, velocities: np.ndarray) -> None:
        self._model.body_pos[self._held] = positions

    def points(self) -> np.ndarray:
        require_stable(self._data)
        mujoco.mj_kinematics(self._model, self._data)
        return self._data.xpos[self._bodies]
