"""The kinds of obstacles that there are, by the key that says which one it is."""

import dataclasses
from typing import Any, Callable, Dict, List, NamedTuple, Tuple

from deformable_manipulation.obstacles.cloud import CloudObstacle
from deformable_manipulation.obstacles.field import FieldObstacle
from deformable_manipulation.obstacles.live_cloud import LiveCloudObstacle
from deformable_manipulation.obstacles.live_field import LiveFieldObstacle
from deformable_manipulation.obstacles.live_voxels import LiveVoxelObstacle
from deformable_manipulation.obstacles.mesh import MeshObstacle
from deformable_manipulation.obstacles.polygon import POLYGON, read_polygon
from deformable_manipulation.obstacles.primitives import (
    BoxObstacle,
    CapsuleObstacle,
    CylinderObstacle,
    HalfSpaceObstacle,
    SphereObstacle,
)
from deformable_manipulation.obstacles.spec import ObstacleSpec
from deformable_manipulation.obstacles.voxels import VoxelObstacle
from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.readers import (
    Custom,
    Node,
    Section,
    Unreadable,
    nearest,
    read_items,
)


class Kind(NamedTuple):
    """A kind of obstacle.

    Attributes:
        section: its keys.
        read: reads and checks an item of the list of obstacles.
    """

    section: Section
    read: Callable[[Node], ObstacleSpec]


def _declared(spec: Any) -> Kind:
    section = Section(spec)
    return Kind(section, section)


KINDS: Dict[str, Kind] = {
    "polygon": Kind(POLYGON, read_polygon),
    **{
        spec.kind: _declared(spec)
        for spec in (
            MeshObstacle,
            HalfSpaceObstacle,
            SphereObstacle,
            BoxObstacle,
            CylinderObstacle,
            CapsuleObstacle,
            CloudObstacle,
            VoxelObstacle,
            FieldObstacle,
            LiveCloudObstacle,
            LiveVoxelObstacle,
            LiveFieldObstacle,
        )
    },
}
COMMON_KEYS = ("name", "translation", "rotation", "motion", "known", "real")


def _own_keys(kind: str) -> List[str]:
    return [key for key in KINDS[kind].section.fields if key not in COMMON_KEYS]


def _read_obstacle(node: Node) -> ObstacleSpec:
    """Which kind it is follows from its keys."""
    if not isinstance(node.value, dict):
        node.fail("must be {}".format(OBSTACLE.allowed))
    given = [kind for kind in KINDS if kind in node.value]
    if len(given) == 1:
        return KINDS[given[0]].read(node)
    if given:
        _report_several(node, given)
        raise Unreadable
    likely = [kind for kind in KINDS if not set(_own_keys(kind)).isdisjoint(node.value)]
    if len(likely) == 1:
        return KINDS[likely[0]].read(node)
    hints = (nearest(str(key), KINDS) for key in node.value if key not in COMMON_KEYS)
    node.report.add(
        node.path,
        "has no shape;{} give one of the keys {}".format(next(hints, ""), ", ".join(KINDS)),
    )
    raise Unreadable


def _report_several(node: Node, given: List[str]) -> None:
    """One kind too many, and what is wrong with the first apart from that."""
    first, *others = given
    for kind in others:
        node.report.add(
            node.path + (kind,), "cannot be combined with {}; remove one of the two".format(first)
        )
    known = KINDS[first].section.fields
    foreign = {key for kind in others for key in _own_keys(kind)} - set(known)
    own = {key: item for key, item in node.value.items() if key not in foreign}
    try:
        KINDS[first].read(dataclasses.replace(node, value=own))
    except Unreadable:
        pass


OBSTACLE = Custom(
    _read_obstacle,
    "a section with a name, one of the keys {}, and the keys that go with it".format(
        ", ".join(KINDS)
    ),
)


def read_obstacles(node: Node) -> Tuple[ObstacleSpec, ...]:
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
