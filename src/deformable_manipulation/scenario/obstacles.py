"""The ``obstacles`` section: one reader per kind of obstacle."""

from typing import Tuple

from deformable_manipulation.distance.polygons import PolygonError, Ring, check_ring, read_ring
from deformable_manipulation.scenario.errors import show
from deformable_manipulation.scenario.files import resolve_file
from deformable_manipulation.scenario.names import ONE_LINE
from deformable_manipulation.scenario.readers import (
    Array,
    Choice,
    Node,
    Number,
    Section,
    UnitQuaternion,
    position,
    read_items,
)
from deformable_manipulation.scenario.spec import PolygonObstacle

_POINT = Array(2, Number("m"), "[a, b]")


class Polygon:
    """A ring: inline points, or the name of a CSV file."""

    allowed = "the name of a CSV file, or a list of points [a, b]"

    def __call__(self, node: Node) -> Ring:
        if not isinstance(node.value, (str, list, tuple)):
            node.fail("must be {}".format(self.allowed))
        try:
            if isinstance(node.value, str):
                return read_ring(resolve_file(node.value, node.directory))
            return check_ring(read_items(node, _POINT))
        except (PolygonError, FileNotFoundError) as error:
            node.fail(str(error))


POLYGON_OBSTACLE = Section(
    PolygonObstacle,
    {
        "name": ONE_LINE,
        "polygon": Polygon(),
        "plane": Choice("xy", "yz", "xz"),
        "translation": position(),
        "rotation": UnitQuaternion(),
    },
    rename={"polygon": "points"},
)


def read_obstacles(node: Node) -> Tuple[PolygonObstacle, ...]:
    """Read and check the ``obstacles`` section; nothing in it means no obstacles."""
    if node.value is None:
        return ()
    if not isinstance(node.value, (list, tuple)):
        node.fail("must be a list of obstacles, each {}".format(POLYGON_OBSTACLE.allowed))
    _check_names(node)
    return read_items(node, POLYGON_OBSTACLE)


def _check_names(node: Node) -> None:
    seen = []
    for index, item in enumerate(node.value):
        name = item.get("name") if isinstance(item, dict) else None
        if isinstance(name, str) and name in seen:
            node.report.add(
                node.path + (str(index), "name"),
                "is the name of another obstacle already; give each its own",
                show(name),
            )
        seen.append(name)
