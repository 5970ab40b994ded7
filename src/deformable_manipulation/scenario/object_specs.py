"""Kinds of objects as data."""

from dataclasses import dataclass
from typing import Tuple

from deformable_manipulation.geometry.pose import Vector
from deformable_manipulation.reading.pose import Pose


@dataclass(frozen=True)
class RodSpec:
    """A rope or rod: ``segments`` rigid segments end to end.

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
    triangles = None  # it is a line

    @property
    def particles(self) -> int:
        """Number of particles that can be held (the segments)."""
        return self.segments

    @property
    def margin(self) -> float:
        """Distance [m] of the surface from the centre line."""
        return self.radius


@dataclass(frozen=True)
class FabricSpec:
    """A fabric: a triangle mesh with mass, membrane and bending stiffness.

    Particle i is vertex i of the mesh. Undeformed, a vertex v lies at
    ``pose.position + pose.orientation * v``.
    """

    vertices: Tuple[Vector, ...]  # m
    triangles: Tuple[Tuple[int, int, int], ...]  # indices of vertices
    density: float  # kg/m^2
    thickness: float  # m
    stretching_compliance: float  # m/N, inverse of the membrane stiffness E t
    bending_compliance: float  # 1/(N m), inverse of the flexural rigidity per width
    damping: float = 10.0  # 1/s, of motion relative to the held points
    pose: Pose = Pose()

    type = "fabric"

    @property
    def particles(self) -> int:
        """Number of particles that can be held (the vertices)."""
        return len(self.vertices)

    @property
    def margin(self) -> float:
        """Distance [m] of the surface from the mid-surface."""
        return 0.5 * self.thickness
