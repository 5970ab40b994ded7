"""A rope or a stiff rod: all that Python knows of this kind of object."""

import dataclasses
import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Callable, Iterator, Optional, Tuple

import numpy as np

from deformable_manipulation.geometry.pose import Quaternion, Vector
from deformable_manipulation.geometry.rotation import rotate
from deformable_manipulation.objects.body import make_body
from deformable_manipulation.objects.common import DAMPING, LARGEST_VALID_STRETCH, kind_keys
from deformable_manipulation.objects.natural_shape import (
    NATURAL_SHAPE,
    NaturalShape,
    check_natural_shape,
)
from deformable_manipulation.objects.point_mass import POINT_MASS, PointMass, check_point_masses
from deformable_manipulation.objects.spec import ObjectSpec
from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.parameter import parameter
from deformable_manipulation.reading.pose import POSE, Pose
from deformable_manipulation.reading.readers import (
    Choice,
    Integer,
    Items,
    Node,
    Number,
    Section,
    Unreadable,
)

_SUBSTEPS = 2  # for the direct solver
# Chains of more segments take more if they hardly resist bending: the length over which they bend
# where they are held, as a part of theirs, and the substeps from there on.
_FEW_SEGMENTS = 140
_SUBSTEPS_OF_CHAINS = ((1.5e-3, 2), (2.5e-4, 4), (0.0, 8))
_GRAVITY = 9.81  # m/s^2
_SOFT_FOAM = 1e4  # Pa
LARGEST_MODULUS = 1e13  # Pa, ten times that of diamond
RETARDATION_TIME = Number("s", at_least=0.0, at_most=100.0)
MODULUS = Number("Pa", above=0.0, at_most=LARGEST_MODULUS)


@dataclass(frozen=True)
class RodSpec(ObjectSpec):
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
    drag_coefficient: float = parameter(
        Number("", at_least=0.0, at_most=100.0),
        "Drag in still air across the axis: 1.2 for a round cross-section. Matters for light "
        "objects that move faster than 1 m/s.",
        default=0.0,
        native=True,
    )
    bending_retardation_time: float = parameter(
        RETARDATION_TIME,
        "Viscosity over stiffness of bending (Kelvin-Voigt): the joints resist being bent quickly. "
        "Slow swings are hardly damped, quick ones much. Ropes have some hundredths of a second; "
        "then lower `damping`.",
        default=0.0,
        native=True,
    )
    torsion_retardation_time: float = parameter(
        RETARDATION_TIME,
        "The same of twist.",
        default=0.0,
        native=True,
    )
    natural_shape: Optional[NaturalShape] = parameter(
        NATURAL_SHAPE,
        "Shape without load, if it is not straight.",
        default=None,
        default_text="straight",
        native=True,
    )
    point_masses: Tuple[PointMass, ...] = parameter(
        Items(POINT_MASS),
        "Masses that the rod carries: markers, plugs, end fittings.",
        default=(),
        default_text="none",
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
    jacobian = "equilibrium"
    disturbance_filter = 0.1
    horizon_length = 3.0
    collision_margin = 0.002
    collision_speed_margin = 0.0
    collision_snap_margin = 0.0
    has_joints = True
    is_surface = False
    rviz_example = "rope_one_assistant"

    @property
    def particles(self) -> int:
        """Number of particles that can be held: the segments."""
        return self.segments

    @property
    def margin(self) -> float:
        """Distance [m] of the surface from the centre line."""
        return self.radius

    def faces(self) -> None:
        """It is a line."""

    def edges(self) -> Tuple[np.ndarray, np.ndarray]:
        """The segments; see :meth:`.ObjectSpec.edges`."""
        ends = np.arange(self.segments)
        lengths = np.full(self.segments, self.length / self.segments)
        return np.stack((ends, ends + 1), axis=1), lengths

    def particle_position(self, particle: int) -> Vector:
        """Centre of a segment of the undeformed rod [m], in the fixed frame."""
        if self.natural_shape is not None:
            return _natural_poses(self)[0][particle]
        along = (particle + 0.5) * self.length / self.segments
        offset = rotate(self.pose.orientation, (along, 0.0, 0.0))
        return tuple(p + o for p, o in zip(self.pose.position, offset))

    def particle_orientation(self, particle: int) -> Quaternion:
        """See :meth:`.ObjectSpec.particle_orientation`."""
        if self.natural_shape is not None:
            return _natural_poses(self)[1][particle]
        return self.pose.orientation

    def free_length(self, first: int, second: int) -> float:
        """Length of rod [m] between the centres of two segments."""
        return self.length / self.segments * abs(first - second)

    def substeps(self, time_step: float) -> int:
        """What suffices for the direct solver."""
        if self.segments <= _FEW_SEGMENTS:
            return _SUBSTEPS
        # The balance of weight and bending stiffness at the ends of a hanging rod.
        bend = math.sqrt(2.0 * self.bending_stiffness / (self.mass * _GRAVITY)) / self.length
        return next(count for least, count in _SUBSTEPS_OF_CHAINS if bend >= least)

    def valid_stretch(self, gravity: Vector) -> float:
        """See :data:`LARGEST_VALID_STRETCH`."""
        return LARGEST_VALID_STRETCH

    def with_factors(self, stiffness: float, density: float) -> "RodSpec":
        """See :meth:`.ObjectSpec.with_factors`."""
        return dataclasses.replace(
            self,
            young_modulus=stiffness * self.young_modulus,
            torsion_modulus=stiffness * self.torsion_modulus,
            density=density * self.density,
        )

    def refined(self, factor: int) -> "RodSpec":
        """The same rod in ``factor`` times as many segments."""
        return dataclasses.replace(self, segments=factor * self.segments)

    def with_random_material(self, draw: Callable[[], float]) -> "RodSpec":
        """Both moduli have the same factor."""
        return self.with_factors(draw(), draw())

    def warnings(self) -> Iterator[str]:
        """See :meth:`.ObjectSpec.warnings`."""
        for key in ("young_modulus", "torsion_modulus"):
            modulus = getattr(self, key)
            if modulus < _SOFT_FOAM:
                yield (
                    "object.{}: {:g} Pa is softer than soft foam. Moduli are in Pa, not in MPa or "
                    "GPa".format(key, modulus)
                )

    @property
    def stiffness_over_mass(self) -> float:
        """Bending stiffness over mass per length, E I / (rho A) [m^4/s^2]."""
        return self.bending_stiffness / self.mass_per_length

    @property
    def mass(self) -> float:
        """Of the whole rod with its point masses [kg]."""
        return self.mass_per_length * self.length + sum(each.mass for each in self.point_masses)

    def segment_masses(self) -> Tuple[np.ndarray, np.ndarray]:
        """Masses (N,) [kg] of the segments with the point masses that they carry.

        And moments (N,) [kg m] of masses off the segments' centres, towards the last end.
        """
        piece = self.length / self.segments
        masses = np.full(self.segments, self.mass_per_length * self.length / self.segments)
        moments = np.zeros(self.segments)
        for point in self.point_masses:
            segment = min(int(point.at / piece), self.segments - 1)
            masses[segment] += point.mass
            moments[segment] += point.mass * (point.at - (segment + 0.5) * piece)
        return masses, moments

    @property
    def mass_per_length(self) -> float:
        """Without point masses [kg/m]."""
        return self.density * math.pi * self.radius**2

    @property
    def bending_stiffness(self) -> float:
        """Of the cross-section, E I [N m^2]."""
        return self.young_modulus * math.pi * self.radius**4 / 4.0

    @property
    def torsion_stiffness(self) -> float:
        """Of the cross-section, G J [N m^2]."""
        return self.torsion_modulus * math.pi * self.radius**4 / 2.0

    def description(self) -> str:
        """What it is, in a few words."""
        return "rod of {:g} m, radius {:g} m, {} segments".format(
            self.length, self.radius, self.segments
        )

    def material_description(self) -> str:
        """What it is made of: the values that a material preset and the scenario give."""
        return (
            "{:.4g} kg/m^3, Young's modulus {:.4g} Pa, torsion modulus {:.4g} Pa; mass "
            "{:.4g} kg, bending stiffness {:.4g} N m^2".format(
                self.density,
                self.young_modulus,
                self.torsion_modulus,
                self.mass,
                self.bending_stiffness,
            )
        )


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
    fits = (
        check_natural_shape(node, rod.natural_shape, rod.length, rod.segments),
        check_point_masses(node, rod.point_masses, rod.length),
    )
    if not all(fits):
        raise Unreadable
    return rod


@lru_cache(maxsize=16)
def _natural_poses(rod: RodSpec) -> Tuple[Tuple[Vector, ...], Tuple[Quaternion, ...]]:
    """Positions and orientations of the segments without load, laid out from its pose."""
    body = make_body(rod)
    return _rows(body.positions()), _rows(body.orientations())


def _rows(array: np.ndarray) -> Tuple[Tuple[float, ...], ...]:
    return tuple(tuple(map(float, row)) for row in array)
