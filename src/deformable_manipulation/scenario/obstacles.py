"""The ``obstacles`` section: one reader per kind of obstacle."""

import dataclasses
from typing import Tuple, Union

from deformable_manipulation.geometry.polygons import PolygonError, Ring, check_ring, read_ring
from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.meshes import MeshFile, Scale
from deformable_manipulation.reading.names import ONE_LINE
from deformable_manipulation.reading.readers import (
    Array,
    Choice,
    Custom,
    Node,
    Number,
    Section,
    UnitQuaternion,
    Unreadable,
    position,
    read_items,
)
from deformable_manipulation.scenario.motions import MOTION
from deformable_manipulation.scenario.spec import MeshObstacle, PolygonObstacle
from deformable_manipulation.system.package_files import resolve_file

Obstacle = Union[PolygonObstacle, MeshObstacle]

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
        "motion": MOTION,
    },
    rename={"polygon": "points"},
)


MESH_OBSTACLE = Section(
    MeshObstacle,
    {
        "name": ONE_LINE,
        "mesh": MeshFile(),
        "translation": position(),
        "rotation": UnitQuaternion(),
        "scale": Scale(),
        "motion": MOTION,
    },
)


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
        return POLYGON_OBSTACLE(node)
    node.report.add(node.path + ("mesh",), "does not go with polygon; remove one of the two")
    others = {key: item for key, item in node.value.items() if key not in ("mesh", "scale")}
    POLYGON_OBSTACLE.read_parts(dataclasses.replace(node, value=others))
    raise Unreadable


OBSTACLE = Custom(
    _read_obstacle,
    "a section with keys name, polygon and plane or mesh and scale, translation, rotation, motion",
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
                "is the name of another obstacle already; give each its own",
                show(name),
            )
        seen.append(name)
