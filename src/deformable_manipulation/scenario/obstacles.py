"""The ``obstacles`` section: one reader per kind of obstacle."""

import dataclasses
from dataclasses import dataclass
from typing import Optional, Sequence, Tuple, Union

from deformable_manipulation.geometry.polygon_files import read_rings
from deformable_manipulation.geometry.polygons import (
    Points,
    PolygonError,
    Rings,
    check_rings,
    has_several_rings,
    points_of,
    rings_of,
)
from deformable_manipulation.geometry.pose import Quaternion, Vector
from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.meshes import MeshFile, Scale
from deformable_manipulation.reading.names import ONE_LINE
from deformable_manipulation.reading.origin import (
    ORIGIN_KEY,
    PLANE_ORIGIN,
    SPACE_ORIGIN,
    origin_beside,
)
from deformable_manipulation.reading.parameter import parameter
from deformable_manipulation.reading.readers import (
    Array,
    Choice,
    Custom,
    Items,
    Node,
    Number,
    Section,
    UnitQuaternion,
    Unreadable,
    position,
    read_items,
)
from deformable_manipulation.scenario.motions import MOTION, Motion
from deformable_manipulation.system.package_files import resolve_file

_POINT = Array(2, Number("m"), "[a, b]")
_RING = Items(_POINT)


class Polygon:
    """Rings around a region: inline points, or the name of a CSV or GeoJSON file."""

    type, unit, range = "file or list", "m", ""
    allowed = (
        "the name of a CSV or GeoJSON file, a list of points [a, b], or a list of such lists: an "
        "outline and its holes"
    )

    def __call__(self, node: Node) -> Points:
        if not isinstance(node.value, (str, list, tuple)):
            node.fail("must be {}".format(self.allowed))
        origin = origin_beside(node, 2)
        try:
            if isinstance(node.value, str):
                return points_of(read_rings(resolve_file(node.value, node.directory), origin))
            return points_of(check_rings(_moved(self._inline(node), origin)))
        except (PolygonError, FileNotFoundError) as error:
            node.fail(str(error))

    def _inline(self, node: Node) -> Points:
        """The points that stand in the scenario."""
        is_nested = all(isinstance(each, (list, tuple)) and each for each in node.value)
        if is_nested and has_several_rings(node.value):
            return read_items(node, _RING)
        return read_items(node, _POINT)


def _moved(points: Points, origin: Sequence[float]) -> Points:
    """The points with their origin taken off."""
    return points_of(
        tuple(tuple((a - origin[0], b - origin[1]) for a, b in ring) for ring in rings_of(points))
    )


_NAME = parameter(ONE_LINE, "Appears in messages and markers.")
_TRANSLATION = parameter(position(), "Moves the obstacle.", default=(0.0, 0.0, 0.0))
_ROTATION = parameter(
    UnitQuaternion(),
    "Turns it about its origin, before `translation`.",
    default=(0.0, 0.0, 0.0, 1.0),
)
_MOTION = parameter(
    MOTION,
    "What moves it, see [below](#obstacles-motion).",
    default=None,
    default_text="none: it stands still",
)


@dataclass(frozen=True)
class PolygonObstacle:
    """A polygon in a plane, endless along the plane's normal.

    ``points`` are a ring, or several: what an odd number of them enclose is inside. A point (a, b)
    lies at ``translation + rotation * embed(a, b)``, where ``embed`` puts a and b on the two axes
    that ``plane`` names ("yz": a on y, b on z).
    """

    name: str = _NAME
    points: Points = parameter(
        Polygon(),
        "Ring of points `[a, b]`, or an outline and its holes.",
        allowed="see below",
        key="polygon",
    )
    plane: str = parameter(Choice("xy", "yz", "xz"), "Axes of a and b.", default="yz")
    translation: Vector = _TRANSLATION
    rotation: Quaternion = _ROTATION
    motion: Optional[Motion] = _MOTION

    @property
    def rings(self) -> Rings:
        """The rings, of which there may be only one."""
        return rings_of(self.points)


@dataclass(frozen=True)
class _PolygonOrigin:
    """What is used up when a polygon is read."""

    origin: Optional[Sequence[float]] = parameter(
        PLANE_ORIGIN,
        "`[a, b]`, subtracted from all points of `polygon`. Use it for maps, whose coordinates are "
        "far from 0.",
        default=None,
        default_text="`[0.0, 0.0]`",
    )


@dataclass(frozen=True)
class MeshObstacle:
    """The surface of triangles in a file.

    A vertex v of the file lies at ``translation + rotation * (scale * (v - origin))``.
    """

    name: str = _NAME
    mesh: str = parameter(
        MeshFile(),
        "OBJ, PLY, STL, COLLADA or another format; any number of triangles.",
        allowed="see below",
    )
    translation: Vector = _TRANSLATION
    rotation: Quaternion = _ROTATION
    scale: Vector = parameter(
        Scale(),
        "Metres per unit of the file, along its axes; 0.001 for a file in mm.",
        default=(1.0, 1.0, 1.0),
    )
    origin: Vector = parameter(
        SPACE_ORIGIN,
        "Subtracted from all vertices of the file, in its units (m for COLLADA and 3MF). Use it "
        "for files whose coordinates are far from 0.",
        default=(0.0, 0.0, 0.0),
    )
    motion: Optional[Motion] = _MOTION


POLYGON_OBSTACLE = Section(PolygonObstacle, also=_PolygonOrigin)
MESH_OBSTACLE = Section(MeshObstacle)
Obstacle = Union[PolygonObstacle, MeshObstacle]


def _read_obstacle(node: Node) -> Obstacle:
    """Which kind it is follows from its keys."""
    if not isinstance(node.value, dict):
        node.fail("must be {}".format(OBSTACLE.allowed))
    if "polygon" in node.value:
        return _read_polygon(node)
    if {"mesh", "scale"}.isdisjoint(node.value):
        node.report.add(
            node.path + ("polygon",),
            "is missing; give {}; or give mesh instead, {}".format(
                Polygon.allowed, MeshFile.allowed
            ),
        )
        raise Unreadable
    return MESH_OBSTACLE(node)


def _read_polygon(node: Node) -> PolygonObstacle:
    if "mesh" not in node.value:
        parts = POLYGON_OBSTACLE.read_parts(node)
        if len(parts) < len(POLYGON_OBSTACLE.fields):
            raise Unreadable
        del parts[ORIGIN_KEY]
        return PolygonObstacle(**parts)
    node.report.add(node.path + ("mesh",), "cannot be combined with polygon; remove one of the two")
    others = {key: item for key, item in node.value.items() if key not in ("mesh", "scale")}
    POLYGON_OBSTACLE.read_parts(dataclasses.replace(node, value=others))
    raise Unreadable


OBSTACLE = Custom(
    _read_obstacle,
    "a section with keys name, polygon and plane or mesh and scale, origin, translation, rotation, "
    "motion",
)


def read_obstacles(node: Node) -> Tuple[Obstacle, ...]:
    """Read and check the ``obstacles`` section; nothing in it means no obstacles."""
    if node.value is None:
        return ()
    if not isinstance(node.value, (list, tuple)):
        node.fail("must be a list of obstacles, each {}".format(OBSTACLE.allowed))
    _check_names(node)
    return read_items(node, OBSTACLE)


def _check_names(node: Node) -> None:
    seen = []
    for index, item in enumerate(node.value):
        name = item.get("name") if isinstance(item, dict) else None
        if isinstance(name, str) and name in seen:
            node.report.add(
                node.path + (str(index), "name"),
                "is already the name of another obstacle; give each its own name",
                show(name),
            )
        seen.append(name)
