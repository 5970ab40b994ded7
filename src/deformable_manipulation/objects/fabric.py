"""Fabrics."""

import dataclasses
import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Callable, Dict, Tuple

import numpy as np

from deformable_manipulation import _pbd
from deformable_manipulation.geometry.pose import Pose, Vector
from deformable_manipulation.geometry.rotation import rotate
from deformable_manipulation.objects.fabric_grid import LARGEST_PARTICLE_COUNT, read_grid
from deformable_manipulation.objects.object_spec import (
    DAMPING,
    LARGEST_VALID_STRETCH,
    POSE,
    ObjectSpec,
)
from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.meshes import InlineMesh, Mesh, Scale, scaled
from deformable_manipulation.reading.readers import Array, Node, Number, Section, Unreadable

_SHAPE = ("size", "resolution", "mesh", "scale")
_LARGEST_PULL = 10.0  # times the weight of a fabric
_SUBSTEP = 1e-3  # s; one iteration per substep is all that a fabric's constraints get
_ROUNDING = 1e-6  # of a substep


@dataclass(frozen=True)
class FabricSpec(ObjectSpec):
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
    is_surface = True
    has_joint_solver = False
    default_jacobian = "perturbed_copies"
    rviz_example = "fabric_three_assistants"

    @classmethod
    def read(cls, node: Node) -> "FabricSpec":
        """Read and check the ``object`` section of a fabric."""
        parts = FABRIC.read_parts(node)
        mesh = _read_mesh(node, parts)
        if len(parts) < len(FABRIC.fields):
            raise Unreadable
        material = {key: value for key, value in parts.items() if key not in _SHAPE}
        fabric = cls(vertices=mesh.vertices, triangles=mesh.triangles, **material)
        _check_body(node, fabric)
        return fabric

    def to_mapping(self) -> Dict[str, Any]:
        """The section with its mesh inline."""
        mapping = super().to_mapping()
        mesh = {key: mapping.pop(key) for key in ("vertices", "triangles")}
        return {"type": mapping.pop("type"), "mesh": mesh, **mapping}

    @property
    def particles(self) -> int:
        """Number of particles that can be held (the vertices)."""
        return len(self.vertices)

    @property
    def margin(self) -> float:
        """Distance [m] of the surface from the mid-surface."""
        return 0.5 * self.thickness

    def particle_position(self, particle: int) -> Vector:
        """A vertex of the undeformed fabric [m], in the fixed frame."""
        offset = rotate(self.pose.orientation, self.vertices[particle])
        return tuple(p + o for p, o in zip(self.pose.position, offset))

    def free_length(self, first: int, second: int) -> float:
        """Greatest distance [m] between two vertices that does not stretch the fabric."""
        return _weightless_body(self).free_length(first, second)

    def edges(self) -> Tuple[np.ndarray, np.ndarray]:
        """The triangles' sides: indices of their ends (E, 2), undeformed lengths (E,) [m]."""
        triangles = np.array(self.triangles)
        sides = np.concatenate((triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]))
        edges = np.unique(np.sort(sides, axis=1), axis=0)
        vertices = np.array(self.vertices)
        return edges, np.linalg.norm(vertices[edges[:, 1]] - vertices[edges[:, 0]], axis=1)

    def valid_stretch(self, gravity: Vector) -> float:
        """What rods are granted, and what a pull of ten times its weight makes of a mean edge.

        That is 10 x compliance x weight / length. Held by corners at 99 % of its size, a fabric
        pulls on them by several times its weight.
        """
        corners = np.array(self.vertices)[np.array(self.triangles)]
        doubled = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        area = 0.5 * np.linalg.norm(doubled, axis=1).sum()
        weight = self.density * area * np.linalg.norm(gravity)
        mean_length = self.edges()[1].mean()
        pulled = _LARGEST_PULL * self.stretching_compliance * weight / mean_length
        return float(LARGEST_VALID_STRETCH + pulled)

    def auto_substeps(self, time_step: float) -> int:
        """As many as keep each of them short."""
        return math.ceil(time_step / _SUBSTEP - _ROUNDING)

    def make_body(self, gravity: Vector, solver: str) -> _pbd.Body:
        """The C++ fabric, which has no joints; see ObjectSpec."""
        return _pbd.Fabric(
            vertices=np.array(self.vertices),
            triangles=np.array(self.triangles),
            density=self.density,
            thickness=self.thickness,
            stretching_compliance=self.stretching_compliance,
            bending_compliance=self.bending_compliance,
            damping=self.damping,
            gravity=gravity,
            position=self.pose.position,
            orientation=self.pose.orientation,
        )

    def scaled_material(self, stiffness: float, density: float) -> "FabricSpec":
        """The same fabric, as many times as stiff and as dense."""
        return dataclasses.replace(
            self,
            stretching_compliance=self.stretching_compliance / stiffness,
            bending_compliance=self.bending_compliance / stiffness,
            density=density * self.density,
        )

    def varied_material(self, draw: Callable[[], float]) -> "FabricSpec":
        """Stretching and bending do not go together: they depend on the weave."""
        return dataclasses.replace(
            self,
            stretching_compliance=draw() * self.stretching_compliance,
            bending_compliance=draw() * self.bending_compliance,
            density=draw() * self.density,
        )

    def describe(self) -> str:
        """What is carried, in a few words."""
        sizes = (max(axis) - min(axis) for axis in zip(*self.vertices))
        return "fabric of {} m, {:g} kg/m^2, {} particles, {} triangles".format(
            " x ".join("{:.4g}".format(size) for size in sizes if size),
            self.density,
            self.particles,
            len(self.triangles),
        )

    def describe_material(self) -> str:
        """What it is made of."""
        stiffnesses = (
            "{:.4g} {}".format(1.0 / compliance, unit) if compliance else "rigid"
            for compliance, unit in (
                (self.stretching_compliance, "N/m"),
                (self.bending_compliance, "N m"),
            )
        )
        return (
            "{:.4g} kg/m^2, thickness {:.4g} m, stiffness to stretching {}, to bending {}".format(
                self.density, self.thickness, *stiffnesses
            )
        )


FABRIC = Section(
    FabricSpec,
    {
        "size": Array(2, Number("m", above=0.0, at_most=1e3), "[along x, along y]"),
        "resolution": Number("1/m", above=0.0, at_most=1e6),
        "mesh": InlineMesh(),
        "scale": Scale(),
        "density": Number("kg/m^2", above=0.0, at_most=1e4),
        "thickness": Number("m", above=0.0, at_most=1.0),
        "stretching_compliance": Number("m/N", at_least=0.0, at_most=1e6),
        "bending_compliance": Number("1/(N m)", at_least=0.0, at_most=1e12),
        "damping": DAMPING,
        "pose": POSE,
    },
    defaults={"size": None, "resolution": None, "mesh": None, "scale": (1.0, 1.0, 1.0)},
    others=("type", "material"),
)


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
            _report(node, key, "does not go with mesh; remove one of them")
        elif "mesh" not in given and key not in given:
            _report(node, key, "is missing; give size and resolution, or mesh instead")
    if "scale" in given and not isinstance(node.value.get("mesh"), str):
        _report(node, "scale", "is of a mesh file; remove it")


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
        _weightless_body(fabric)
    except _pbd.ParameterError as error:
        for key, value, allowed in error.problems:
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
def _weightless_body(fabric: FabricSpec) -> _pbd.Body:
    return fabric.make_body((0.0, 0.0, 0.0), "")
