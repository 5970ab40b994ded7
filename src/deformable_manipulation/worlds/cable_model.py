"""A rod as MuJoCo's model: a cable of rigid pieces, ball joints with the plugin's elasticity."""

from typing import Sequence

from deformable_manipulation.objects.rod import RodSpec

_XML = """
<mujoco>
  <option timestep="{time_step}" integrator="implicitfast" solver="PGS" gravity="{gravity}">
    <flag contact="disable"/>
  </option>
  <extension><plugin plugin="mujoco.elasticity.cable"/></extension>
  <size memory="200M"/>
  <worldbody>
    {grips}
    <composite prefix="cable" type="cable" curve="s" count="{nodes} 1 1" size="{length}"
               initial="free">
      <plugin plugin="mujoco.elasticity.cable">
        <config key="bend" value="{young_modulus}"/>
        <config key="twist" value="{torsion_modulus}"/>
        <config key="vmax" value="0"/>
      </plugin>
      <joint kind="main" damping="{damping}" armature="{armature}"/>
      <geom type="cylinder" size="{radius}" density="{density}"/>
    </composite>
  </worldbody>
  <equality>{holds}</equality>
</mujoco>
"""
HOLD_STEPS = 2.0  # time constant of the holds in time steps: as stiff as is stable

_GRIP = '<body name="grip{number}" mocap="true" pos="{centre} 0 0"/>'
_CLAMPED = """
<weld body1="grip{number}" body2="{piece}" relpose="-{half} 0 0 1 0 0 0"
      solref="{time_constant} 1" solimp="0.999 0.9999 0.001"/>
"""
_PINNED = """
<connect body1="{piece}" body2="grip{number}" anchor="{half} 0 0"
         solref="{time_constant} 1" solimp="0.999 0.9999 0.001"/>
"""


def piece_name(piece: int, pieces: int) -> str:
    """The name of the body of a piece, 0 to ``pieces`` - 1."""
    ends = {0: "cableB_first", pieces - 1: "cableB_last"}
    return ends.get(piece, f"cableB_{piece}")


def cable_xml(spec: RodSpec, agents: Sequence, gravity: Sequence[float], time_step: float) -> str:
    """The model of a straight cable along x from the origin, with a mocap body for each agent.

    The plugin's forces are explicit in time. Joints with a viscosity of stiffness times step and
    an inertia of stiffness times step squared keep them stable at steps of some milliseconds. Both
    leave the shape at rest as it is, and slow down only bending that is quicker than a few steps.

    Args:
        spec: the rod, in as many segments as the cable has pieces.
        agents: AgentSpecs; each holds the piece of its ``particle`` at its centre.
        gravity: (3,) [m/s^2].
        time_step: [s].
    """
    piece_length = spec.length / spec.segments
    stiffness = spec.bending_stiffness / piece_length  # of a joint [N m/rad]
    grips, holds = [], []
    for number, agent in enumerate(agents):
        place = {
            "number": number,
            "piece": piece_name(agent.particle, spec.segments),
            "centre": (agent.particle + 0.5) * piece_length,
            "half": 0.5 * piece_length,
            "time_constant": HOLD_STEPS * time_step,
        }
        grips.append(_GRIP.format(**place))
        holds.append((_CLAMPED if agent.hold == "clamped" else _PINNED).format(**place))
    return _XML.format(
        time_step=time_step,
        gravity=" ".join(map(str, gravity)),
        grips="".join(grips),
        holds="".join(holds),
        nodes=spec.segments + 1,
        length=spec.length,
        young_modulus=spec.young_modulus,
        torsion_modulus=spec.torsion_modulus,
        damping=max(time_step, spec.bending_retardation_time) * stiffness,
        armature=time_step**2 * stiffness,
        radius=spec.radius,
        density=spec.density,
    )
