"""Readers of triangle meshes: files, and vertices and triangles that stand in the scenario."""

import dataclasses
import os
from typing import Any, Tuple

import numpy as np

from deformable_manipulation.geometry.mesh_files import MeshError, read_mended_mesh
from deformable_manipulation.geometry.mesh_mending import MendedMesh, split_at_corners
from deformable_manipulation.geometry.pose import Vector
from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.origin import origin_beside
from deformable_manipulation.reading.parameter import parameter
from deformable_manipulation.reading.readers import (
    LARGEST_COORDINATE,
    Array,
    Integer,
    Node,
    Number,
    Section,
    Unreadable,
    position,
    read_items,
)
from deformable_manipulation.system.package_files import resolve_file

_LARGEST_INDEX = 2**31 - 1
_FILE = "the name of a mesh file (OBJ, PLY, STL, COLLADA and others)"


class _List:
    """A list of one item or more, all read by one reader."""

    type, unit, range = "list", "", "one or more"

    def __init__(self, item, things: str):
        self._item = item
        self.allowed = "a list of {}, each {}".format(things, item.allowed)

    def __call__(self, node: Node) -> Tuple[Any, ...]:
        if not isinstance(node.value, (list, tuple)) or not node.value:
            node.fail("must be {}".format(self.allowed))
        return read_items(node, self._item)


@dataclasses.dataclass(frozen=True)
class Mesh:
    """Vertices [m, or units of a file] and the triangles between them."""

    vertices: Tuple[Vector, ...] = parameter(_List(position(), "vertices"), "Vertices.")
    triangles: Tuple[Tuple[int, int, int], ...] = parameter(
        _List(Array(3, Integer(0, _LARGEST_INDEX), "[i, j, k]"), "triangles of vertices from 0"),
        "Vertices of each triangle.",
    )
    warnings: Tuple[str, ...] = ()  # what was mended


class Scale:
    """[m per unit] along the three axes: three numbers, or one for all of them."""

    type, unit, range = "number or vector", "m", "1e-6 to 1e6; with a file only"
    _number = Number("m", at_least=1.0 / LARGEST_COORDINATE, at_most=LARGEST_COORDINATE)
    _numbers = Array(3, _number, "[x, y, z]")
    allowed = "{}, or a list [x, y, z] of them".format(_number.allowed)

    def __call__(self, node: Node) -> Vector:
        if isinstance(node.value, (list, tuple)):
            return self._numbers(node)
        return (self._number(node),) * 3


class MeshFile:
    """The name of a mesh file; returns its absolute path.

    The file is read, so that what is wrong with it is found together with all other mistakes,
    unless that has been done before (:attr:`Node.files_are_read`).
    """

    type, unit, range = "file", "", ""
    allowed = _FILE

    def __call__(self, node: Node) -> str:
        if not isinstance(node.value, str) or not node.value:
            node.fail("must be {}".format(self.allowed))
        if node.files_are_read:
            return node.value
        return _read_file(node)[0]


class InlineMesh:
    """A mesh in a file or in the scenario itself; returns vertices and triangles."""

    type, unit, range = "file or section", "m", ""
    allowed = _FILE + ", or a section with keys vertices and triangles"

    def __call__(self, node: Node) -> Mesh:
        if isinstance(node.value, str) and node.value:
            _, mesh = _read_file(node)
            return Mesh(_tuples(mesh.vertices), _tuples(mesh.triangles), tuple(mesh.warnings()))
        if not isinstance(node.value, dict):
            node.fail("must be {}".format(self.allowed))
        mesh = _INLINE(node)
        _check_triangles(node, mesh)
        return mesh if node.files_are_read else _split(mesh)


def scaled(mesh: Mesh, scale: Vector) -> Mesh:
    """The mesh of a file in m."""
    vertices = tuple((scale[0] * x, scale[1] * y, scale[2] * z) for x, y, z in mesh.vertices)
    return dataclasses.replace(mesh, vertices=vertices)


def _split(mesh: Mesh) -> Mesh:
    """The mesh without vertices that lie on edges of triangles."""
    split = split_at_corners(np.array(mesh.vertices), np.array(mesh.triangles))
    if not split.splits:
        return mesh
    return Mesh(mesh.vertices, _tuples(split.triangles), tuple(split.warnings()))


def _check_triangles(node: Node, mesh: Mesh) -> None:
    """Each triangle names three different vertices that are there."""
    last = len(mesh.vertices) - 1
    wrong = [
        index
        for index, triangle in enumerate(mesh.triangles)
        if max(triangle) > last or len(set(triangle)) < 3
    ]
    for index in wrong:
        node.report.add(
            node.path + ("triangles", str(index)),
            "must name three different vertices from 0 to {}".format(last),
            show(list(mesh.triangles[index])),
        )
    if wrong:
        raise Unreadable


def _read_file(node: Node) -> Tuple[str, MendedMesh]:
    """Absolute path and content of the mesh file that a node names."""
    try:
        path = os.path.abspath(str(resolve_file(node.value, node.directory)))
        return path, read_mended_mesh(path, origin_beside(node, 3))
    except (MeshError, FileNotFoundError) as error:
        node.fail(str(error))


def _tuples(array) -> Tuple[Tuple[Any, ...], ...]:
    return tuple(tuple(row) for row in array.tolist())


_INLINE = Section(Mesh)
