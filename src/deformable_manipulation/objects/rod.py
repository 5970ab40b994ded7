"""Ropes and rods."""

import dataclasses
import math
from dataclasses import dataclass
from typing import Callable, Tuple

import numpy as np

from deformable_manipulation import _pbd
from deformable_manipulation.geometry.pose import Pose, Vector
from deformable_manipulation.geometry.rotation import rotate
from deformable_manipulation.objects.object_spec import (
    DAMPING,
    LARGEST_VALID_STRETCH,
    POSE,
    ObjectSpec,
)
from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.readers import Choice, Integer, Node, Number, Section

_LARGEST_MODULUS = 1e13  # Pa, ten times that of diamond
_SUBSTEPS = 2  # for the direct solver


@dataclass(frozen=True)
class RodSpec(ObjectSpec):
    """A rope or rod: ``segments`` rigid segments end to end; they are its particles.

    Undeformed it lies along the x axis of ``pose``, from its first end at the origin.
    """

    length: float  # m
    radius: float  # m
    density: float  # kg/m^3
    segments: int
    young_modulus: float  # Pa, bending
    torsion_modulus: float  # Pa, twist
    stretch: str = "zero"  # "zero", or "from_moduli": axial stiffness E A
    damping: float = 10.0  # 1/s, of motion relative to the held points
    pose: Pose = Pose()

    type = "rod"
    is_surface = False
    has_joint_solver = True
    default_jacobian = "equilibrium"
    rviz_example = "rope_one_assistant"
    triangles = None

    @classmethod
    def read(cls, node: Node) -> "RodSpec":
        """Read and check the ``object`` section of a rod."""
        rod = ROD(node)
        if 2.0 * rod.radius >= rod.length:
            node.report.add(
                node.path + ("radius",),
                "must be less than half of object.length ({:g} m)".format(rod.length),
                show(rod.radius),
            )
        return rod

    @property
    def particles(self) -> int:
        """Number of particles that can be held (the segments)."""
        return self.segments

    @property
    def margin(self) -> float:
        """Distance [m] of the surface from the centre line."""
        return self.radius

    def particle_position(self, particle: int) -> Vector:
        """Centre of a segment of the undeformed rod [m], in the fixed frame."""
        along = (particle + 0.5) * self.length / self.segments
        offset = rotate(self.pose.orientation, (along, 0.0, 0.0))
        return tuple(p + o for p, o in zip(self.pose.position, offset))

    def free_length(self, first: int, second: int) -> float:
        """Length of rod [m] between the centres of two segments."""
        return self.length / self.segments * abs(first - second)

    def edges(self) -> Tuple[np.ndarray, np.ndarray]:
        """The segments: indices of their ends (E, 2), undeformed lengths (E,) [m]."""
        ends = np.arange(self.segments)
        lengths = np.full(self.segments, self.length / self.segments)
        return np.stack((ends, ends + 1), axis=1), lengths

    def valid_stretch(self, gravity: Vector) -> float:
        """The same for all rods."""
        return LARGEST_VALID_STRETCH

    def auto_substeps(self, time_step: float) -> int:
        """The direct solver needs few, whatever the time step."""
        return _SUBSTEPS

    def make_body(self, gravity: Vector, solver: str) -> _pbd.Rod:
        """The C++ rod; see ObjectSpec."""
        return _pbd.Rod(
            length=self.length,
            radius=self.radius,
            density=self.density,
            segments=self.segments,
            young_modulus=self.young_modulus,
            torsion_modulus=self.torsion_modulus,
            stretch=self.stretch,
            damping=self.damping,
            solver=solver,
            gravity=gravity,
            position=self.pose.position,
            orientation=self.pose.orientation,
        )

    def scaled_material(self, stiffness: float, density: float) -> "RodSpec":
        """The same rod, as many times as stiff and as dense."""
        return dataclasses.replace(
            self,
            young_modulus=stiffness * self.young_modulus,
            torsion_modulus=stiffness * self.torsion_modulus,
            density=density * self.density,
        )

    def varied_material(self, draw: Callable[[], float]) -> "RodSpec":
        """Both moduli go together: they are of one material."""
        stiffness = draw()
        return self.scaled_material(stiffness, draw())

    def describe(self) -> str:
        """What is carried, in a few words."""
        return "rod of {:g} m, radius {:g} m, {} segments".format(
            self.length, self.radius, self.segments
        )

    def describe_material(self) -> str:
        """What it is made of."""
        area = math.pi * self.radius**2
        return (
            "{:.4g} kg/m^3, Young's modulus {:.4g} Pa, torsion modulus {:.4g} Pa; in all "
            "{:.4g} kg, bending stiffness {:.4g} N m^2".format(
                self.density,
                self.young_modulus,
                self.torsion_modulus,
                self.density * area * self.length,
                self.young_modulus * area * self.radius**2 / 4.0,
            )
        )


ROD = Section(
    RodSpec,
    {
        "length": Number("m", above=0.0, at_most=1e3),
        "radius": Number("m", above=0.0),
        "density": Number("kg/m^3", above=0.0, at_most=1e5),
        "segments": Integer(2, 10000),
        "young_modulus": Number("Pa", above=0.0, at_most=_LARGEST_MODULUS),
        "torsion_modulus": Number("Pa", above=0.0, at_most=_LARGEST_MODULUS),
        "stretch": Choice("zero", "from_moduli"),
        "damping": DAMPING,
        "pose": POSE,
    },
    others=("type", "material"),
)
