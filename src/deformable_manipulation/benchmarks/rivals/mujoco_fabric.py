"""The cloth in MuJoCo: a flex of two dimensions, an elastic shell of finite elements."""

import mujoco
import numpy as np

from deformable_manipulation.benchmarks.fabric_case import (
    FabricCase,
    FabricModel,
    UndampedFabricModel,
)
from deformable_manipulation.benchmarks.rivals.mujoco_warnings import require_stable

POISSON_RATIO = 0.0  # the springs of a square mesh along its edges have none

_XML = """
<mujoco>
  <option timestep="{time_step}" integrator="{integrator}" gravity="0 0 -{gravity}">
    <flag contact="disable"/>
  </option>
  <size memory="200M"/>
  <worldbody>{bodies}</worldbody>
  <deformable>
    <flex name="cloth" dim="2" body="{names}" element="{elements}" radius="0.0005">
      <contact selfcollide="none"/>
      <elasticity young="{young_modulus}" poisson="{poisson_ratio}" thickness="{thickness}"
                  elastic2d="both"/>
    </flex>
  </deformable>
</mujoco>
"""
# Elastic flexes take no mocap bodies: one that is fixed to the world, whose place there is changed.
_HELD = '<body name="v{name}" pos="{x} {y} {z}"/>'
_FREE = """
<body name="v{name}" pos="{x} {y} {z}">
  <inertial pos="0 0 0" mass="{mass}" diaginertia="{inertia} {inertia} {inertia}"/>
  <joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/>
  <joint type="slide" axis="0 0 1"/>
</body>
"""


def make(case: FabricCase, integrator: str, step_us: int) -> FabricModel:
    """The cloth of a case, in time steps of so many microseconds."""
    return MujocoFabric(case, integrator, 1e-6 * step_us)


class MujocoFabric(UndampedFabricModel):
    """The material that is as stiff as the case's along the edges and against bending.

    A shell of thickness t has the stiffnesses E t and E t^3 / 12, which gives E and t. Of the
    integrators, ``discrete`` is implicit in the elasticity, ``Euler`` is not.
    """

    def __init__(self, case: FabricCase, integrator: str, time_step: float):
        self.time_step = time_step
        self.settings = f"flex, {integrator}"
        self._model = mujoco.MjModel.from_xml_string(self._xml(case, integrator))
        self._data = mujoco.MjData(self._model)
        self._bodies = np.array([self._model.body(f"v{i}").id for i in range(len(case.vertices))])
        self._held = self._bodies[case.held]

    def _xml(self, case: FabricCase, integrator: str) -> str:
        thickness = np.sqrt(12.0 * case.stretching_compliance / case.bending_compliance)
        bodies = []
        for name, ((x, y, z), mass) in enumerate(zip(case.vertices, case.masses)):
            form = _HELD if name in case.held else _FREE
            bodies.append(form.format(name=name, x=x, y=y, z=z, mass=mass, inertia=1e-3 * mass))
        return _XML.format(
            time_step=self.time_step,
            integrator=integrator,
            gravity=case.gravity,
            bodies="".join(bodies),
            names=" ".join(f"v{i}" for i in range(len(case.vertices))),
            elements=" ".join(str(v) for triangle in case.triangles for v in triangle),
            young_modulus=1.0 / (case.stretching_compliance * thickness),
            poisson_ratio=POISSON_RATIO,
            thickness=thickness,
        )

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
