"""Obstacles that are given by numbers."""

from abc import abstractmethod
from dataclasses import dataclass
from typing import Any, ClassVar, List, Optional, Tuple

import numpy as np

from deformable_manipulation.geometry.pose import Quaternion, Vector
from deformable_manipulation.obstacles.drawings import Drawing, box_surface, turned_surface
from deformable_manipulation.obstacles.motions import Motion
from deformable_manipulation.obstacles.spec import (
    KNOWN,
    MOTION_OF_OBSTACLE,
    NAME,
    REAL,
    ROTATION,
    TRANSLATION,
    ObstacleSpec,
)
from deformable_manipulation.reading.parameter import parameter
from deformable_manipulation.reading.readers import LARGEST_COORDINATE, Number, Section, vector

_SMALLEST = 1e-6  # m
_LENGTH = Number("m", at_least=_SMALLEST, at_most=LARGEST_COORDINATE)
_DRAWN, _DRAWN_DEPTH = 3.0, 0.1  # m, to all sides and below the plane: what is drawn of half-spaces
_ARC = np.linspace(0.0, 0.5 * np.pi, 9)  # rad, of the outline of a ball


class _Primitive(ObstacleSpec):
    """What all of them have in common; the numbers are those of the section :attr:`shape`."""

    is_around_origin = True

    @property
    def shape(self) -> Any:
        """The section with its numbers."""
        return getattr(self, self.kind)

    @abstractmethod
    def make(self, maker: Any) -> Any:
        """The C++ core's obstacle, made by its class PrimitiveObstacle."""

    def native(self) -> Tuple[Any, List[str]]:
        from deformable_manipulation import _distance

        return self.make(_distance.PrimitiveObstacle), []


class _Bounded(_Primitive):
    """Those that end somewhere, around their origin."""

    @property
    @abstractmethod
    def half_sides(self) -> np.ndarray:
        """(3,) [m] of the box around it."""

    def corners(self) -> np.ndarray:
        signs = np.stack(np.meshgrid((-1, 1), (-1, 1), (-1, 1)), axis=-1).reshape(-1, 3)
        return signs * self.half_sides


@dataclass(frozen=True)
class HalfSpace:
    """The section ``half_space``."""

    normal: Vector = parameter(
        vector("", at_least=-LARGEST_COORDINATE, at_most=LARGEST_COORDINATE),
        "Away from the obstacle, of any length but 0.",
        default=(0.0, 0.0, 1.0),
    )


class _HalfSpaceSection(Section):
    """A section with a normal that has a length."""

    def __call__(self, node):
        shape = super().__call__(node)
        if not np.linalg.norm(shape.normal) > 1e-6:
            node.child("normal", node.value["normal"]).fail("must be longer than 1e-6")
        return shape


@dataclass(frozen=True)
class HalfSpaceObstacle(_Primitive):
    """All points on and behind a plane through ``translation``: a table, the ground or a wall."""

    kind: ClassVar[str] = "half_space"
    name: str = NAME
    half_space: HalfSpace = parameter(_HalfSpaceSection(HalfSpace), "Its normal.")
    translation: Vector = TRANSLATION
    rotation: Quaternion = ROTATION
    motion: Optional[Motion] = MOTION_OF_OBSTACLE
    known: bool = KNOWN
    real: bool = REAL

    @property
    def endless(self) -> str:
        """See :class:`.ObstacleSpec`, like the others."""
        return "endless along and behind its plane"

    def make(self, maker: Any) -> Any:
        return maker.half_space(self.half_space.normal)

    def corners(self) -> np.ndarray:
        """Of the piece of its plane that is drawn."""
        sides = (-_DRAWN, _DRAWN)
        plate = np.stack(np.meshgrid(sides, sides, 0.0), axis=-1).reshape(-1, 3)
        return plate @ self._axes()

    def drawing(self) -> Drawing:
        low, high = (-_DRAWN, -_DRAWN, -_DRAWN_DEPTH), (_DRAWN, _DRAWN, 0.0)
        surface = box_surface(np.array(low), np.array(high))
        return surface._replace(triangles=surface.triangles @ self._axes())

    def description(self) -> str:
        x, y, z = self.half_space.normal
        return "half-space with the normal ({:g}, {:g}, {:g})".format(x, y, z)

    def _axes(self) -> np.ndarray:
        """Rows: two axes in the plane, and the normal."""
        normal = np.array(self.half_space.normal) / np.linalg.norm(self.half_space.normal)
        first = np.cross(np.eye(3)[int(np.argmin(np.abs(normal)))], normal)
        first /= np.linalg.norm(first)
        return np.array((first, np.cross(normal, first), normal))


@dataclass(frozen=True)
class Sphere:
    """The section ``sphere``."""

    radius: float = parameter(_LENGTH, "Its radius.")


@dataclass(frozen=True)
class SphereObstacle(_Bounded):
    """A ball around ``translation``."""

    kind: ClassVar[str] = "sphere"
    name: str = NAME
    sphere: Sphere = parameter(Section(Sphere), "Its radius.")
    translation: Vector = TRANSLATION
    rotation: Quaternion = ROTATION
    motion: Optional[Motion] = MOTION_OF_OBSTACLE
    known: bool = KNOWN
    real: bool = REAL

    @property
    def half_sides(self) -> np.ndarray:
        """See :class:`_Bounded`, like the others."""
        return np.full(3, self.sphere.radius)

    def make(self, maker: Any) -> Any:
        return maker.sphere(self.sphere.radius)

    def drawing(self) -> Drawing:
        return turned_surface(_ball_outline(self.sphere.radius, 0.0))

    def description(self) -> str:
        return "sphere of radius {:g} m".format(self.sphere.radius)


@dataclass(frozen=True)
class Box:
    """The section ``box``."""

    size: Vector = parameter(
        vector("m", at_least=_SMALLEST, at_most=LARGEST_COORDINATE),
        "Its sides along its own x, y and z axis.",
    )


@dataclass(frozen=True)
class BoxObstacle(_Bounded):
    """A box whose middle is at ``translation``."""

    kind: ClassVar[str] = "box"
    name: str = NAME
    box: Box = parameter(Section(Box), "Its sides.")
    translation: Vector = TRANSLATION
    rotation: Quaternion = ROTATION
    motion: Optional[Motion] = MOTION_OF_OBSTACLE
    known: bool = KNOWN
    real: bool = REAL

    @property
    def half_sides(self) -> np.ndarray:
        """See :class:`_Bounded`, like the others."""
        return 0.5 * np.array(self.box.size)

    def make(self, maker: Any) -> Any:
        return maker.box(self.box.size)

    def drawing(self) -> Drawing:
        return box_surface(-self.half_sides, self.half_sides)

    def description(self) -> str:
        return "box of {:g} x {:g} x {:g} m".format(*self.box.size)


@dataclass(frozen=True)
class Cylinder:
    """The section ``cylinder``."""

    radius: float = parameter(_LENGTH, "Its radius.")
    length: float = parameter(_LENGTH, "Its length along its own z axis.")


@dataclass(frozen=True)
class CylinderObstacle(_Bounded):
    """A cylinder along its z axis, whose middle is at ``translation``."""

    kind: ClassVar[str] = "cylinder"
    name: str = NAME
    cylinder: Cylinder = parameter(Section(Cylinder), "Its radius and its length.")
    translation: Vector = TRANSLATION
    rotation: Quaternion = ROTATION
    motion: Optional[Motion] = MOTION_OF_OBSTACLE
    known: bool = KNOWN
    real: bool = REAL

    @property
    def half_sides(self) -> np.ndarray:
        """See :class:`_Bounded`, like the others."""
        shape = self.cylinder
        return np.array((shape.radius, shape.radius, 0.5 * shape.length))

    def make(self, maker: Any) -> Any:
        return maker.cylinder(self.cylinder.radius, self.cylinder.length)

    def drawing(self) -> Drawing:
        radius, half = self.cylinder.radius, 0.5 * self.cylinder.length
        return turned_surface(
            np.array(((0.0, -half), (radius, -half), (radius, half), (0.0, half)))
        )

    def description(self) -> str:
        shape = self.cylinder
        return "cylinder of radius {:g} m, {:g} m long".format(shape.radius, shape.length)


@dataclass(frozen=True)
class Capsule:
    """The section ``capsule``."""

    radius: float = parameter(_LENGTH, "Its radius.")
    length: float = parameter(
        _LENGTH,
        "Length of its straight part, along its own z axis. With its ends it is longer "
        "by two radii.",
    )


@dataclass(frozen=True)
class CapsuleObstacle(_Bounded):
    """A cylinder with round ends along its z axis, whose middle is at ``translation``."""

    kind: ClassVar[str] = "capsule"
    name: str = NAME
    capsule: Capsule = parameter(Section(Capsule), "Its radius and its length.")
    translation: Vector = TRANSLATION
    rotation: Quaternion = ROTATION
    motion: Optional[Motion] = MOTION_OF_OBSTACLE
    known: bool = KNOWN
    real: bool = REAL

    @property
    def half_sides(self) -> np.ndarray:
        """See :class:`_Bounded`, like the others."""
        shape = self.capsule
        return np.array((shape.radius, shape.radius, 0.5 * shape.length + shape.radius))

    def make(self, maker: Any) -> Any:
        return maker.capsule(self.capsule.radius, self.capsule.length)

    def drawing(self) -> Drawing:
        return turned_surface(_ball_outline(self.capsule.radius, 0.5 * self.capsule.length))

    def description(self) -> str:
        shape = self.capsule
        return "capsule of radius {:g} m, {:g} m long without its ends".format(
            shape.radius, shape.length
        )


def _ball_outline(radius: float, half: float) -> np.ndarray:
    """Half the outline (K, 2) [m] of a ball that is cut in two and pulled apart along z."""
    aside, up = radius * np.sin(_ARC), radius * np.cos(_ARC)
    lower = np.column_stack((aside, -half - up))
    return np.concatenate((lower, lower[::-1] * (1.0, -1.0)))
