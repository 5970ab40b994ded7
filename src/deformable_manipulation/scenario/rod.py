"""The ``object`` section of a rope or rod, and where its particles are before it is deformed."""

import re
from dataclasses import dataclass
from typing import Dict

from deformable_manipulation.geometry.pose import Vector
from deformable_manipulation.geometry.rotation import rotate
from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.parameter import Parameter, parameter
from deformable_manipulation.reading.pose import POSE, Pose
from deformable_manipulation.reading.readers import (
    Choice,
    Integer,
    Node,
    Number,
    Section,
    Text,
)

LARGEST_MODULUS = 1e13  # Pa, ten times that of diamond
DAMPING = Number("1/s", at_least=0.0, at_most=1e4)
MODULUS = Number("Pa", above=0.0, at_most=LARGEST_MODULUS)


@dataclass(frozen=True)
class RodSpec:
    """A rope or rod: ``segments`` rigid segments end to end.

    Undeformed it lies along the x axis of ``pose``, from its first end at the origin.
    """

    length: float = parameter(
        Number("m", above=0.0, at_most=1e3), "Length of the undeformed rod.", native=True
    )
    radius: float = parameter(
        Number("m", above=0.0),
        "Radius of its round cross-section. Distances are measured from the surface.",
        allowed="below half the length",
        native=True,
    )
    density: float = parameter(
        Number("kg/m^3", above=0.0, at_most=1e5),
        "Mass per volume of the solid cross-section: mass / (pi radius^2 length).",
        native=True,
    )
    segments: int = parameter(
        Integer(2, 10000),
        "More segments give a finer shape and cost proportionally more time; 28 suits 2 m of rope.",
        native=True,
    )
    young_modulus: float = parameter(
        MODULUS,
        "Resists bending. Soft ropes have 1e+6 to 1e+8, stiff rods 1e+9 and more.",
        native=True,
    )
    torsion_modulus: float = parameter(
        MODULUS,
        "Resists twisting. About a third of `young_modulus` for solid materials.",
        native=True,
    )
    stretch: str = parameter(
        Choice("zero", "from_moduli"),
        "`zero`: the segments stay end to end. `from_moduli`: axial stiffness young_modulus x "
        "cross-section.",
        default="zero",
        native=True,
    )
    damping: float = parameter(
        DAMPING,
        "Decay rate of motion relative to the held points. Lower it for an object that swings for "
        "long, raise it for one that comes to rest sooner.",
        default=10.0,
        native=True,
    )
    pose: Pose = parameter(
        POSE,
        "Pose of the undeformed object.",
        default=Pose(),
        default_text="at the origin, along x",
        native=True,
    )

    type = "rod"
    triangles = None  # it is a line

    @property
    def particles(self) -> int:
        """Number of particles that can be held (the segments)."""
        return self.segments

    @property
    def margin(self) -> float:
        """Distance [m] of the surface from the centre line."""
        return self.radius


def kind_keys(kind: str, given: str) -> Dict[str, Parameter]:
    """Keys that every ``object`` section has, whatever its kind.

    Args:
        kind: word of its ``type``.
        given: keys that a material of this kind gives, in Markdown.
    """
    return {
        "type": Parameter(Choice(kind), "Kind of object."),
        "material": Parameter(
            Text(re.compile(r".+"), "[materials.md](materials.md)"),
            "Gives {}. Keys of the scenario replace those of the material.".format(given),
            default_text="none",
        ),
    }


ROD = Section(
    RodSpec, others=kind_keys("rod", "`radius`, `density`, `young_modulus` and `torsion_modulus`")
)


def read_rod(node: Node) -> RodSpec:
    """Read and check the ``object`` section of a rod."""
    rod = ROD(node)
    if 2.0 * rod.radius >= rod.length:
        node.report.add(
            node.path + ("radius",),
            "must be less than half of object.length ({:g} m)".format(rod.length),
            show(rod.radius),
        )
    return rod


def rod_particle_position(rod: RodSpec, particle: int) -> Vector:
    """Centre of a segment of the undeformed rod [m], in the fixed frame."""
    along = (particle + 0.5) * rod.length / rod.segments
    offset = rotate(rod.pose.orientation, (along, 0.0, 0.0))
    return tuple(p + o for p, o in zip(rod.pose.position, offset))


def rod_free_length(rod: RodSpec, first: int, second: int) -> float:
    """Length of rod [m] between the centres of two segments."""
    return rod.length / rod.segments * abs(first - second)
