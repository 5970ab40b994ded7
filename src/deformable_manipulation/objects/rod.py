"""A rope or a stiff rod: all that Python knows of this kind of object."""

import dataclasses
import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Callable, Iterator, Optional, Sequence, Tuple

import numpy as np

from deformable_manipulation.geometry.pose import Quaternion, Vector
from deformable_manipulation.geometry.rotation import rotate
from deformable_manipulation.objects.body import make_body
from deformable_manipulation.objects.common import DAMPING, LARGEST_VALID_STRETCH, kind_keys
from deformable_manipulation.objects.grip import GRIP, Grip, check_grips
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
    grips: Tuple[Grip, ...] = parameter(
        Items(GRIP),
        "Where it is held, if a gripper keeps another length than that of a segment straight. It "
        "follows from the agents' `grip_length`; give it where there are no agents, as for "
        "`replay`. See [real_objects.md](real_objects.md#what-a-clamp-holds).",
        default=(),
        default_text="from the agents",
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
        return np.stack((ends, ends + 1), axis=1), np.array(self.segment_lengths)

    def particle_position(self, particle: int) -> Vector:
        """Centre of a segment of the undeformed rod [m], in the fixed frame."""
        if self.natural_shape is not None:
            return _natural_poses(self)[0][particle]
        offset = rotate(self.pose.orientation, (self.centre(particle), 0.0, 0.0))
        return tuple(p + o for p, o in zip(self.pose.position, offset))

    def particle_orientation(self, particle: int) -> Quaternion:
        """See :meth:`.ObjectSpec.particle_orientation`."""
        if self.natural_shape is not None:
            return _natural_poses(self)[1][particle]
        return self.pose.orientation

    def free_length(self, first: int, second: int) -> float:
        """Length of rod [m] between the centres of two segments."""
        if self.has_equal_segments:
            return self.length / self.segments * abs(first - second)
        return abs(self.centre(first) - self.centre(second))

    def held_by(self, grips: Sequence[Tuple[int, Optional[float]]]) -> "RodSpec":
        """See :meth:`.ObjectSpec.held_by`."""
        own = any(length is not None for _, length in grips)
        held = tuple(Grip(*grip) for grip in sorted(grips)) if own else ()
        return dataclasses.replace(self, grips=held)

    def division_problem(self) -> Optional[str]:
        """Why it cannot be divided into segments next to its grips, None if it can."""
        from deformable_manipulation import _pbd  # late, see make_body

        try:
            self.arc_lengths  # noqa: B018
        except _pbd.ParameterError as error:
            return str(error)
        return None

    @property
    def has_equal_segments(self) -> bool:
        """Whether all segments are as long: no grip has a length of its own."""
        return all(grip.length is None for grip in self.grips)

    @property
    def segment_lengths(self) -> Tuple[float, ...]:
        """Lengths of all segments [m]."""
        if self.has_equal_segments:
            return (self.length / self.segments,) * self.segments
        return tuple(np.diff(self.arc_lengths))

    @property
    def arc_lengths(self) -> Tuple[float, ...]:
        """Arc lengths of the segments' ends [m] from the rod's first end."""
        if self.has_equal_segments:
            return tuple(np.arange(self.segments + 1) * self.length / self.segments)
        return _divided(self)[0]

    @property
    def joint_lengths(self) -> Tuple[float, ...]:
        """Length of rod [m] that bends in each joint."""
        if self.has_equal_segments:
            return (self.length / self.segments,) * (self.segments - 1)
        return _divided(self)[1]

    def segment_at(self, place: float) -> int:
        """The segment at an arc length [m]; beyond the ends, the last one there."""
        if self.has_equal_segments:
            return int(np.clip(place / self.length * self.segments, 0, self.segments - 1))
        after = int(np.searchsorted(self.arc_lengths, place, side="right"))
        return min(max(after - 1, 0), self.segments - 1)

    def centre(self, particle: int) -> float:
        """Arc length [m] of a segment's centre."""
        if self.has_equal_segments:
            return (particle + 0.5) * self.length / self.segments
        return 0.5 * (self.arc_lengths[particle] + self.arc_lengths[particle + 1])

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
        finer = dataclasses.replace(self, segments=factor * self.segments, grips=())
        return finer.held_by([(factor * g.particle + factor // 2, g.length) for g in self.grips])

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
        lengths = np.array(self.segment_lengths)
        masses = self.mass_per_length * self.length / self.segments * (lengths / piece)
        moments = np.zeros(self.segments)
        ends = np.array(self.arc_lengths)
        for point in self.point_masses:
            segment = min(int(np.searchsorted(ends, point.at, "right")) - 1, self.segments - 1)
            masses[segment] += point.mass
            moments[segment] += point.mass * (point.at - 0.5 * (ends[segment] + ends[segment + 1]))
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
        lengths = self.segment_lengths
        sizes = (
            ""
            if self.has_equal_segments
            else " of {:.2g} to {:.2g} m".format(min(lengths), max(lengths))
        )
        return "rod of {:g} m, radius {:g} m, {} segments{}".format(
            self.length, self.radius, self.segments, sizes
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
        check_grips(node, rod.grips, rod.length, rod.segments),
    )
    problem = rod.division_problem() if all(fits) else None
    if problem is not None:
        node.report.add(node.path + ("grips",), problem)
    if problem is not None or not all(fits):
        raise Unreadable
    return rod


@lru_cache(maxsize=16)
def _divided(rod: RodSpec) -> Tuple[Tuple[float, ...], Tuple[float, ...]]:
    """Arc lengths of the segments' ends and what bends in each joint [m]."""
    body = make_body(rod)
    return tuple(map(float, body.arc_lengths)), tuple(map(float, body.joint_lengths))


@lru_cache(maxsize=16)
def _natural_poses(rod: RodSpec) -> Tuple[Tuple[Vector, ...], Tuple[Quaternion, ...]]:
    """Positions and orientations of the segments without load, laid out from its pose."""
    body = make_body(rod)
    return _rows(body.positions()), _rows(body.orientations())


def _rows(array: np.ndarray) -> Tuple[Tuple[float, ...], ...]:
    return tuple(tuple(map(float, row)) for row in array)
