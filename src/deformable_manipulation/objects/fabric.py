"""A fabric of triangles: all that Python knows of this kind of object."""

import dataclasses
import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Callable, Dict, Iterator, Optional, Tuple

import numpy as np

from deformable_manipulation.geometry.pose import Quaternion, Vector
from deformable_manipulation.geometry.rotation import rotate
from deformable_manipulation.objects.body import make_body
from deformable_manipulation.objects.common import DAMPING, LARGEST_VALID_STRETCH, kind_keys
from deformable_manipulation.objects.fabric_grid import LARGEST_PARTICLE_COUNT, read_grid
from deformable_manipulation.objects.spec import ObjectSpec
from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.meshes import InlineMesh, Mesh, Scale, scaled
from deformable_manipulation.reading.parameter import declared, parameter
from deformable_manipulation.reading.pose import POSE, Pose
from deformable_manipulation.reading.readers import Array, Node, Number, Section, Unreadable

_SUBSTEP = 1e-3  # s; one iteration per substep is all that a fabric's constraints get
_MOST_SUBSTEPS = 10  # times the usual number, unless the scenario wants more
_ROUNDING = 1e-6  # of a substep
_LARGEST_PULL = 10.0  # times the weight of a fabric
_RUBBERY = 0.05  # m/N, more than that of thin rubber


@dataclass(frozen=True)
class FabricSpec(ObjectSpec):
    """A fabric: a triangle mesh with mass, membrane and bending stiffness.

    Particle i is vertex i of the mesh. Undeformed, a vertex v lies at
    ``pose.position + pose.orientation * v``.
    """

    vertices: Tuple[Vector, ...]  # m
    triangles: Tuple[Tuple[int, int, int], ...]  # indices of vertices
    density: float = parameter(
        Number("kg/m^2", above=0.0, at_most=1e4), "Mass per area.", native=True
    )
    thickness: float = parameter(
        Number("m", above=0.0, at_most=1.0),
        "Distances are measured from the surface; half of the thickness lies on either side of the "
        "mesh.",
        native=True,
    )
    stretching_compliance: float = parameter(
        Number("m/N", at_least=0.0, at_most=1e6),
        "1 / (Young's modulus x thickness). 0 makes the fabric inextensible.",
        native=True,
    )
    bending_compliance: float = parameter(
        Number("1/(N m)", at_least=0.0, at_most=1e12), "1 / flexural rigidity.", native=True
    )
    damping: float = parameter(
        DAMPING, "Decay rate of motion relative to the held points.", default=10.0, native=True
    )
    pose: Pose = parameter(
        POSE,
        "Pose of the undeformed object.",
        default=Pose(),
        default_text="at the origin, in the xy plane",
        native=True,
    )
    mended: Tuple[str, ...] = dataclasses.field(default=(), compare=False, repr=False)

    type = "fabric"
    jacobian = "perturbed_copies"
    disturbance_filter = 0.0
    horizon_length = 0.0
    # A fold that snaps moves the nearest point by some millimetres before anything can answer, and
    # not every snap shows in the copies before.
    collision_margin = 0.01
    collision_speed_margin = 0.2
    collision_snap_margin = 0.01
    has_joints = False
    is_surface = True
    rviz_example = "fabric_three_assistants"

    def warnings(self) -> Iterator[str]:
        """See :meth:`.ObjectSpec.warnings`."""
        yield from ("object.mesh: " + each for each in self.mended)
        if self.stretching_compliance > _RUBBERY:
            yield (
                "object.stretching_compliance: a square sheet grows by {:g} m per newton along its "
                "sides. Compliances are in m/N, and cloth has 1e-5 to 1e-3".format(
                    self.stretching_compliance
                )
            )

    @property
    def particles(self) -> int:
        """Number of particles that can be held: the vertices."""
        return len(self.vertices)

    @property
    def margin(self) -> float:
        """Distance [m] of the surface from the mid-surface."""
        return 0.5 * self.thickness

    def faces(self) -> np.ndarray:
        """See :meth:`.ObjectSpec.faces`."""
        return np.array(self.triangles)

    def edges(self) -> Tuple[np.ndarray, np.ndarray]:
        """The sides of the triangles; see :meth:`.ObjectSpec.edges`."""
        triangles = np.array(self.triangles)
        sides = np.concatenate((triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]))
        edges = np.unique(np.sort(sides, axis=1), axis=0)
        vertices = np.array(self.vertices)
        return edges, np.linalg.norm(vertices[edges[:, 1]] - vertices[edges[:, 0]], axis=1)

    def particle_position(self, particle: int) -> Vector:
        """A vertex of the undeformed fabric [m], in the fixed frame."""
        offset = rotate(self.pose.orientation, self.vertices[particle])
        return tuple(p + o for p, o in zip(self.pose.position, offset))

    def particle_orientation(self, particle: int) -> Quaternion:
        """See :meth:`.ObjectSpec.particle_orientation`."""
        return self.pose.orientation

    def free_length(self, first: int, second: int) -> float:
        """The shortest way [m] between two vertices over the surface."""
        return _body(self).free_length(first, second)

    def substeps(self, time_step: float) -> int:
        """Of a length that suits fabrics, or as short as the stiffness of its springs needs."""
        usual = math.ceil(time_step / _SUBSTEP - _ROUNDING)
        if self.stretching_compliance == 0.0:
            return usual  # no substep is short enough
        return _body(self).substeps_for_stiffness(time_step, usual, _MOST_SUBSTEPS * usual)

    def valid_stretch(self, gravity: Vector) -> float:
        """More than that of rods by what a pull of ten times its weight does.

        That is 10 x compliance x weight / length of an edge of mean length. Held by corners at 99 %
        of its size, a fabric pulls on them by several times its weight.
        """
        weight = self.density * self._areas().sum() * np.linalg.norm(gravity)
        mean_length = self.edges()[1].mean()
        pulled = _LARGEST_PULL * self.stretching_compliance * weight / mean_length
        return float(LARGEST_VALID_STRETCH + pulled)

    def masses(self) -> np.ndarray:
        """Of the vertices (V,) [kg]: a third of that of each triangle around."""
        shares = np.repeat(self.density * self._areas() / 3.0, 3)
        return np.bincount(np.ravel(self.triangles), shares, minlength=self.particles)

    def _areas(self) -> np.ndarray:
        """Of the triangles (T,) [m^2]."""
        corners = np.array(self.vertices)[np.array(self.triangles)]
        doubled = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        return 0.5 * np.linalg.norm(doubled, axis=1)

    def with_factors(self, stiffness: float, density: float) -> "FabricSpec":
        """See :meth:`.ObjectSpec.with_factors`."""
        return dataclasses.replace(
            self,
            stretching_compliance=self.stretching_compliance / stiffness,
            bending_compliance=self.bending_compliance / stiffness,
            density=density * self.density,
        )

    def with_random_material(self, draw: Callable[[], float]) -> "FabricSpec":
        """Each compliance has a factor of its own."""
        return dataclasses.replace(
            self,
            stretching_compliance=draw() * self.stretching_compliance,
            bending_compliance=draw() * self.bending_compliance,
            density=draw() * self.density,
        )

    def description(self) -> str:
        """What it is, in a few words."""
        sizes = (max(axis) - min(axis) for axis in zip(*self.vertices))
        return "fabric of {} m, {:g} kg/m^2, {} particles, {} triangles".format(
            " x ".join("{:.4g}".format(size) for size in sizes if size),
            self.density,
            self.particles,
            len(self.triangles),
        )

    def material_description(self) -> str:
        """What it is made of: the values that a material preset and the scenario give."""
        stiffnesses = (
            "{:.4g} {}".format(1.0 / compliance, unit) if compliance else "rigid"
            for compliance, unit in (
                (self.stretching_compliance, "N/m"),
                (self.bending_compliance, "N m"),
            )
        )
        form = "{:.4g} kg/m^2, thickness {:.4g} m, stretching stiffness {}, bending stiffness {}"
        return form.format(self.density, self.thickness, *stiffnesses)

    def to_mapping(self) -> Dict[str, Any]:
        """The section ``object`` as plain values, with the mesh inline."""
        mapping = super().to_mapping()
        del mapping["mended"]
        mesh = {key: mapping.pop(key) for key in ("vertices", "triangles")}
        return {"type": mapping.pop("type"), "mesh": mesh, **mapping}


@dataclass(frozen=True)
class _Shape:
    """Keys that give the mesh."""

    size: Optional[Tuple[float, float]] = parameter(
        Array(2, Number("m", above=0.0, at_most=1e3), "[along x, along y]"),
        "Size of a rectangle, along the x and y axes of `pose` from its origin.",
        default=None,
        default_text="none",
        allowed="a whole number of cells",
    )
    resolution: Optional[float] = parameter(
        Number("1/m", above=0.0, at_most=1e6),
        "Cells per metre. More cells give finer folds and cost more time.",
        default=None,
        default_text="none",
        allowed="at most 20000 particles",
    )
    mesh: Optional[Mesh] = parameter(
        InlineMesh(),
        "A mesh of any shape.",
        default=None,
        default_text="none",
        allowed="see below",
    )
    scale: Vector = parameter(
        Scale(), "Metres per unit of the file, along its axes.", default=(1.0, 1.0, 1.0)
    )


_SHAPE = tuple(declared(_Shape))
FABRIC = Section(
    FabricSpec,
    also=_Shape,
    others=kind_keys("fabric", "`density`, `thickness` and both compliances"),
)


def read_fabric(node: Node) -> FabricSpec:
    """Read and check the ``object`` section of a fabric."""
    parts = FABRIC.read_parts(node)
    mesh = _read_mesh(node, parts)
    if len(parts) < len(FABRIC.fields):
        raise Unreadable
    material = {key: value for key, value in parts.items() if key not in _SHAPE}
    fabric = FabricSpec(mesh.vertices, mesh.triangles, mended=mesh.warnings, **material)
    _check_body(node, fabric)
    return fabric


def _read_mesh(node: Node, parts: Dict[str, Any]) -> Mesh:
    """The mesh from either size and resolution or mesh, and scale."""
    given = [key for key in _SHAPE if key in node.value]
    _check_combination(node, given)
    if not all(key in parts for key in _SHAPE):
        raise Unreadable
    if "mesh" in given:
        return _checked_count(node, scaled(parts["mesh"], parts["scale"]))
    if "size" in given and "resolution" in given:
        return read_grid(node, parts["size"], parts["resolution"])
    raise Unreadable


def _check_combination(node: Node, given) -> None:
    """Report keys of the shape that do not go together."""
    for key in ("size", "resolution"):
        if "mesh" in given and key in given:
            _report(node, key, "cannot be combined with mesh; remove one of the two")
        elif "mesh" not in given and key not in given:
            _report(node, key, "is missing; give size and resolution, or mesh instead")
    if "scale" in given and not isinstance(node.value.get("mesh"), str):
        _report(node, "scale", "applies only to mesh files; remove it")


def _checked_count(node: Node, mesh: Mesh) -> Mesh:
    if len(mesh.vertices) > LARGEST_PARTICLE_COUNT:
        _report(
            node,
            "mesh",
            "has {} vertices; at most {} are allowed".format(
                len(mesh.vertices), LARGEST_PARTICLE_COUNT
            ),
        )
        raise Unreadable
    return mesh


def _report(node: Node, key: str, message: str) -> None:
    value = node.value.get(key)
    node.report.add(node.path + (key,), message, "" if value is None else show(value))


def _check_body(node: Node, fabric: FabricSpec) -> None:
    """Report what the simulation refuses, which knows best what it can simulate."""
    try:
        _body(fabric)
    except ValueError as error:
        problems = getattr(error, "problems", ())  # of a _pbd.ParameterError
        for key, value, allowed in problems:
            node.report.add(node.path + _key_path(node, key), "must be {}".format(allowed), value)
        raise Unreadable from None


def _key_path(node: Node, key: str) -> Tuple[str, ...]:
    """Where below ``object`` a parameter of the simulation comes from."""
    if key in node.value:
        return (key,)
    mesh = node.value.get("mesh")
    if mesh is None:
        return ("size",)
    return ("mesh", key) if isinstance(mesh, dict) and key in mesh else ("mesh",)


@lru_cache(maxsize=4)
def _body(fabric: FabricSpec):
    return make_body(fabric)
