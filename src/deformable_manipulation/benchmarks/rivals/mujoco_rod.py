"""The rod in MuJoCo: a composite cable with the plugin mujoco.elasticity.cable."""

import mujoco
import numpy as np

from deformable_manipulation.benchmarks.rivals.mujoco_warnings import require_stable
from deformable_manipulation.benchmarks.rod_case import ROPE, RodCase
from deformable_manipulation.benchmarks.rod_model import RodModel, UndampedRodModel

TIME_STEP = 0.005  # s
FINE_TIME_STEP = 0.002  # s, its default: needed for more segments than
FINE_SEGMENTS = 45

_XML = """
<mujoco>
  <option timestep="{time_step}" integrator="implicitfast" solver="PGS" gravity="0 0 -{gravity}">
    <flag contact="disable"/>
  </option>
  <extension><plugin plugin="mujoco.elasticity.cable"/></extension>
  <size memory="50M"/>
  <worldbody>
    <composite prefix="cable" type="cable" curve="s" count="{nodes} 1 1" size="{length}"
               initial="{initial}">
      <plugin plugin="mujoco.elasticity.cable">
        <config key="bend" value="{young_modulus}"/>
        <config key="twist" value="{torsion_modulus}"/>
        <config key="vmax" value="0"/>
      </plugin>
      <joint kind="main" damping="{joint_damping}"/>
      <geom type="cylinder" size="{radius}" density="{density}"/>
    </composite>
    {hand}
  </worldbody>
  {equality}
</mujoco>
"""
_HAND = '<body name="hand" mocap="true" pos="{length} 0 0"/>'
_EQUALITY = """
  <equality>
    <connect body1="cableB_last" body2="hand" anchor="{segment_length} 0 0"
             solref="{stiff_time} 1" solimp="0.99 0.999 0.001"/>
  </equality>
"""


def make(case: RodCase) -> RodModel:
    """The rod of a case."""
    return MujocoRod(case)


class MujocoRod(UndampedRodModel):
    """Bodies with ball joints in joint coordinates; the plugin bends and twists them.

    The plugin's forces are integrated explicitly. Viscous joints, which are integrated implicitly,
    keep them stable at these steps: damping of stiffness x time step, which is gone within a step
    or so and does not change the shape at rest.
    """

    def __init__(self, case: RodCase):
        rope = case.load == ROPE
        self.time_step = TIME_STEP if case.segments <= FINE_SEGMENTS else FINE_TIME_STEP
        self.settings = "cable, implicitfast, PGS"
        self._segment_length = case.segment_length
        self._model = mujoco.MjModel.from_xml_string(self._xml(case, rope))
        self._data = mujoco.MjData(self._model)
        nodes = case.segment_length * np.arange(case.segments + 1)
        # The elasticity of half a segment at the clamp is left out: it ends in a first segment
        # that is rigid, as if clamped at its middle.
        self._clamp = 0.0 if rope else 0.5 * case.segment_length
        self._first = 0 if rope else 1
        self._arcs = nodes[self._first :] - self._clamp
        self.free_length = case.length - self._clamp

    def _xml(self, case: RodCase, rope: bool) -> str:
        values = {
            "time_step": self.time_step,
            "gravity": case.gravity,
            "nodes": case.segments + 1,
            "length": case.length,
            "segment_length": case.segment_length,
            "radius": case.radius,
            "density": case.density,
            "young_modulus": case.young_modulus,
            "torsion_modulus": case.torsion_modulus,
            "joint_damping": self.time_step * case.bending_stiffness / case.segment_length,
            "initial": "ball" if rope else "none",
            "stiff_time": 2.0 * self.time_step,  # the least that is stable
        }
        hand = _HAND.format(**values) if rope else ""
        equality = _EQUALITY.format(**values) if rope else ""
        return _XML.format(hand=hand, equality=equality, **values)

    def advance(self, count: int) -> None:
        mujoco.mj_step(self._model, self._data, nstep=count)

    def damp(self, factor: float) -> None:
        self._data.qvel *= factor

    def place_end(self, x: float, velocity: float) -> None:
        self._data.mocap_pos[0] = (x, 0.0, 0.0)

    def points(self) -> np.ndarray:
        require_stable(self._data)
        mujoco.mj_kinematics(self._model, self._data)
        bodies = slice(1, len(self._arcs) + self._first)  # 0 is the world
        starts = self._data.xpos[bodies]
        along = self._data.xmat[bodies][-1].reshape(3, 3)[:, 0]
        nodes = np.vstack([starts, starts[-1] + self._segment_length * along])
        return nodes[self._first :, ::2] - (self._clamp, 0.0)

    def arc_lengths(self) -> np.ndarray:
        return self._arcs
