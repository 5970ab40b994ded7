"""3D Manufacturing Format (3MF)."""

import zipfile
from typing import Dict, Tuple

import numpy as np

from deformable_manipulation.mesh_formats.faces import FormatError, RawMesh
from deformable_manipulation.mesh_formats.packed import member, open_zip
from deformable_manipulation.mesh_formats.parts import Assembly, check_depth, check_range
from deformable_manipulation.mesh_formats.xml_tree import (
    Element,
    children,
    listed_numbers,
    parsed,
)

_METRES = {
    "micron": 1e-6,
    "millimeter": 1e-3,
    "centimeter": 1e-2,
    "inch": 0.0254,
    "foot": 0.3048,
    "meter": 1.0,
}
_Key = Tuple[str, str]  # the model that holds an object, and its number there


def read(data: bytes, largest: int) -> RawMesh:
    """The objects [m] that are to be built, where they are placed.

    Raises:
        FormatError: with what is wrong.
    """
    with open_zip(data) as archive:
        return _Package(archive, largest).mesh()


class _Package:
    def __init__(self, archive: zipfile.ZipFile, largest: int):
        names = [name for name in archive.namelist() if name.lower().endswith(".model")]
        if not names:
            raise FormatError("it is no 3MF file: no .model is in it")
        self._models = {"/" + name: parsed(member(archive, name, largest)) for name in names}
        self._root = _start(archive, largest, self._models)
        self._objects: Dict[_Key, Element] = {
            (path, each.attrib.get("id", "")): each
            for path, model in self._models.items()
            for each in model.iter("object")
        }
        self._meshes: Dict[_Key, RawMesh] = {}
        self._assembly = Assembly()

    def mesh(self) -> RawMesh:
        model = self._models[self._root]
        unit = model.attrib.get("unit", "millimeter")
        if unit not in _METRES:
            text = "its unit is '{}'; allowed: {}"
            raise FormatError(text.format(unit, ", ".join(_METRES)))
        for item in children(model.find("build"), "item"):
            self._add(item, self._root, np.eye(4), 0)
        return self._assembly.mesh(_METRES[unit])

    def _add(self, reference: Element, model: str, above: np.ndarray, depth: int) -> None:
        """What an item or a component refers to."""
        check_depth(depth)
        path = reference.attrib.get("path", model)
        key = (path, reference.attrib.get("objectid", ""))
        if key not in self._objects:
            text = "<{}> refers to object '{}', which is not in the file"
            raise FormatError(text.format(reference.tag, key[1]))
        place = above @ _placement(reference.attrib.get("transform"))
        if self._objects[key].find("mesh") is not None:
            self._assembly.add(self._mesh(key), place)
        for component in children(self._objects[key].find("components"), "component"):
            self._add(component, path, place, depth + 1)

    def _mesh(self, key: _Key) -> RawMesh:
        if key not in self._meshes:
            mesh = self._objects[key].find("mesh")
            vertices = _table(mesh, "vertices", "vertex", ("x", "y", "z"), float)
            triangles = _table(mesh, "triangles", "triangle", ("v1", "v2", "v3"), np.int64)
            check_range(triangles.ravel(), len(vertices), "triangles of object '{}'".format(key[1]))
            self._meshes[key] = RawMesh(vertices, triangles)
        return self._meshes[key]


def _start(archive: zipfile.ZipFile, largest: int, models: Dict[str, Element]) -> str:
    """The model that the package begins with."""
    if "_rels/.rels" in archive.namelist():
        for relation in parsed(member(archive, "_rels/.rels", largest)).iter("Relationship"):
            target = "/" + relation.attrib.get("Target", "").lstrip("/")
            if target in models:
                return target
    return next(iter(models))


def _table(mesh, group: str, row: str, keys: Tuple[str, ...], kind) -> np.ndarray:
    rows = children(mesh.find(group), row)
    text = " ".join(each.attrib.get(key, "?") for each in rows for key in keys)
    return listed_numbers(text, group, kind).reshape(-1, 3)


def _placement(text) -> np.ndarray:
    """The matrix (4, 4) of column vectors of twelve numbers, which are of row vectors."""
    matrix = np.eye(4)
    if text is not None:
        numbers = listed_numbers(text, "transform")
        if len(numbers) != 12:
            raise FormatError("a transform has {} numbers, not 12".format(len(numbers)))
        matrix[:3] = numbers.reshape(4, 3).T
    return matrix
