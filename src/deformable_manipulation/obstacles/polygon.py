"""Polygons, endless along their normal."""

from dataclasses import dataclass
from typing import Any, ClassVar, Iterator, List, Optional, Sequence, Tuple

import numpy as np

from deformable_manipulation.geometry.planes import PLANE_AXES
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
from deformable_manipulation.obstacles.drawings import Drawing, Surface
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
from deformable_manipulation.reading.origin import ORIGIN_KEY, PLANE_ORIGIN, origin_beside
from deformable_manipulation.reading.parameter import parameter
from deformable_manipulation.reading.readers import (
    Array,
    Choice,
    Items,
    Node,
    Number,
    Section,
    Unreadable,
    read_items,
)
from deformable_manipulation.system.package_files import resolve_file

_POINT = Array(2, Number("m"), "[a, b]")
_RING = Items(_POINT)
_HALF_WIDTH = 0.25  # m, of the piece that is drawn


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


@dataclass(frozen=True)
class PolygonObstacle(ObstacleSpec):
    """A polygon in a plane, endless along the plane's normal.

    ``points`` are a ring, or several: what an odd number of them enclose is inside. A point (a, b)
    lies at ``translation + rotation * embed(a, b)``, where ``embed`` puts a and b on the two axes
    that ``plane`` names ("yz": a on y, b on z).
    """

    kind: ClassVar[str] = "polygon"
    name: str = NAME
    points: Points = parameter(
        Polygon(),
        "Ring of points `[a, b]`, or an outline and its holes.",
        allowed="see below",
        key="polygon",
    )
    plane: str = parameter(Choice("xy", "yz", "xz"), "Axes of a and b.", default="yz")
    translation: Vector = TRANSLATION
    rotation: Quaternion = ROTATION
    motion: Optional[Motion] = MOTION_OF_OBSTACLE
    known: bool = KNOWN
    real: bool = REAL

    @property
    def rings(self) -> Rings:
        """The rings, of which there may be only one."""
        return rings_of(self.points)

    @property
    def endless(self) -> str:
        """See :class:`.ObstacleSpec`, like the others."""
        return "endless across its plane"

    def problems(self) -> Iterator[str]:
        if self.plane not in PLANE_AXES:
            allowed = ", ".join("'{}'".format(name) for name in PLANE_AXES)
            yield "plane is {!r}; allowed: {}".format(self.plane, allowed)
        yield from super().problems()

    def native(self) -> Tuple[Any, List[str]]:
        from deformable_manipulation import _distance

        return _distance.PlanarObstacle(check_rings(self.points), self.plane), []

    def corners(self) -> np.ndarray:
        return self.embedded(np.concatenate([np.array(ring) for ring in self.rings]))

    def drawing(self, half_width: float = _HALF_WIDTH) -> Drawing:
        """The piece within some distance [m] of its plane."""
        # Imported late: it needs Shapely, which only drawings need.
        from deformable_manipulation.geometry.prisms import prism

        axes = self.embedded(np.eye(2))
        return Surface(prism(self.rings, axes, half_width))

    def description(self) -> str:
        return "polygon of {} points{}, plane {}".format(
            sum(map(len, self.rings)),
            " in {} rings".format(len(self.rings)) if len(self.rings) > 1 else "",
            self.plane,
        )

    def embedded(self, points: np.ndarray) -> np.ndarray:
        """Points (..., 2) [m] of its plane as points (..., 3) of its own frame."""
        return points @ np.eye(3)[list(PLANE_AXES[self.plane])]


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


POLYGON = Section(PolygonObstacle, also=_PolygonOrigin)


def read_polygon(node: Node) -> PolygonObstacle:
    """Read and check a polygon."""
    parts = POLYGON.read_parts(node)
    if len(parts) < len(POLYGON.fields):
        raise Unreadable
    del parts[ORIGIN_KEY]
    return PolygonObstacle(**parts)
