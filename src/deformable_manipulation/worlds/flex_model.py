"""A fabric as MuJoCo's model: a flex of two dimensions, an elastic shell of finite elements."""

from typing import Container, Sequence, Union

import numpy as np

# Triangles stretched in their plane are a quarter as stiff as the modulus and the thickness that
# the engine is given (version 3.17).
_MEMBRANE = 4.0

_XML = """
<mujoco>
  <option timestep="{time_step}" integrator="{integrator}" gravity="{gravity}">
    <flag contact="disable"/>
  </option>
  <size memory="200M"/>
  <worldbody>{bodies}</worldbody>
  <deformable>
    <flex name="cloth" dim="2" body="{names}" element="{elements}" radius="0.0005">
      <contact selfcollide="none"/>
      <elasticity young="{young_modulus}" poisson="0" thickness="{thickness}"
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


def flex_xml(
    vertices: np.ndarray,
    triangles: np.ndarray,
    masses: Union[Sequence[float], np.ndarray],
    held: Container[int],
    compliances: Sequence[float],
    time_step: float,
    integrator: str = "Euler",
    gravity: Sequence[float] = (0.0, 0.0, -9.81),
) -> str:
    """The model; body ``v0`` is vertex 0 and so on.

    A shell of thickness t has the stiffnesses E t and E t^3 / 12, which gives E and t, but for
    :data:`_MEMBRANE`. Its Poisson
    ratio is 0, as that of springs along the rows of a mesh. Of the integrators, ``discrete`` is
    implicit in the elasticity, ``Euler`` is not.

    Args:
        vertices: (V, 3) [m] of the undeformed fabric.
        triangles: (T, 3) vertices.
        masses: (V,) [kg].
        held: vertices that are fixed where their bodies are put.
        compliances: of stretching [m/N] and of bending [1/(N m)].
        time_step: [s].
        integrator: of MuJoCo.
        gravity: (3,) [m/s^2].
    """
    stretching, bending = compliances
    stretching /= _MEMBRANE
    thickness = np.sqrt(12.0 * stretching / bending)
    bodies = []
    for name, ((x, y, z), mass) in enumerate(zip(vertices, masses)):
        form = _HELD if name in held else _FREE
        bodies.append(form.format(name=name, x=x, y=y, z=z, mass=mass, inertia=1e-3 * mass))
    return _XML.format(
        time_step=time_step,
        integrator=integrator,
        gravity=" ".join(map(str, gravity)),
        bodies="".join(bodies),
        names=" ".join(f"v{i}" for i in range(len(vertices))),
        elements=" ".join(str(v) for triangle in triangles for v in triangle),
        young_modulus=1.0 / (stretching * thickness),
        thickness=thickness,
    )
