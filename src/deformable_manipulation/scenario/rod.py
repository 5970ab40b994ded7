"""The ``object`` section of a rope or rod, and where its particles are before it is deformed."""

from deformable_manipulation.geometry.pose import Vector
from deformable_manipulation.geometry.rotation import rotate
from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.pose import POSE
from deformable_manipulation.reading.readers import (
    Choice,
    Integer,
    Node,
    Number,
    Section,
)
from deformable_manipulation.scenario.object_specs import RodSpec

LARGEST_MODULUS = 1e13  # Pa, ten times that of diamond
DAMPING = Number("1/s", at_least=0.0, at_most=1e4)

ROD = Section(
    RodSpec,
    {
        "length": Number("m", above=0.0, at_most=1e3),
        "radius": Number("m", above=0.0),
        "density": Number("kg/m^3", above=0.0, at_most=1e5),
        "segments": Integer(2, 10000),
        "young_modulus": Number("Pa", above=0.0, at_most=LARGEST_MODULUS),
        "torsion_modulus": Number("Pa", above=0.0, at_most=LARGEST_MODULUS),
        "stretch": Choice("zero", "from_moduli"),
        "damping": DAMPING,
        "pose": POSE,
    },
    others=("type", "material"),
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
