"""COLLADA (.dae)."""

from typing import Dict

import numpy as np

from deformable_manipulation.mesh_formats.collada_geometry import geometry_mesh
from deformable_manipulation.mesh_formats.faces import FormatError, RawMesh
from deformable_manipulation.mesh_formats.parts import Assembly, check_depth
from deformable_manipulation.mesh_formats.xml_tree import Element, children, parsed, text_numbers


def read(data: bytes) -> RawMesh:
    """The geometries [m] of the scene, where its nodes place them; all of them if it has none.

    The unit of the file is respected. Its upward axis is not: as in RViz, x, y and z are those of
    the file. What is skinned has the shape of its geometry.

    Raises:
        FormatError: with what is wrong.
    """
    root = parsed(data)
    if root.tag != "COLLADA":
        raise FormatError("it is no COLLADA file: it begins with <{}>".format(root.tag))
    return _Scene(root).mesh()


class _Scene:
    def __init__(self, root: Element):
        self._root = root
        self._by_id: Dict[str, Element] = {
            element.attrib["id"]: element for element in root.iter() if "id" in element.attrib
        }
        self._meshes: Dict[str, RawMesh] = {}
        self._assembly = Assembly()

    def mesh(self) -> RawMesh:
        for scene in self._scenes():
            for node in children(scene, "node"):
                self._add_node(node, np.eye(4), 0)
        if self._assembly.is_empty():
            for geometry in self._root.iter("geometry"):
                self._assembly.add(self._geometry(geometry), np.eye(4))
        return self._assembly.mesh(self._metres())

    def _metres(self) -> float:
        unit = self._root.find("asset/unit")
        text = "1" if unit is None else unit.attrib.get("meter", "1")
        try:
            metres = float(text.replace(",", "."))
        except ValueError:
            metres = 0.0
        if not 0.0 < metres < np.inf:
            raise FormatError("its unit is meter='{}', which is no positive number".format(text))
        return metres

    def _scenes(self):
        """The visual scene that is shown, or else the first one."""
        instance = self._root.find("scene/instance_visual_scene")
        if instance is not None:
            yield self._referred(instance)
        else:
            yield from list(self._root.iter("visual_scene"))[:1]

    def _referred(self, instance: Element) -> Element:
        url = instance.attrib.get("url", "")
        if url[:1] != "#" or url[1:] not in self._by_id:
            text = "<{}> refers to '{}', which is not in the file"
            raise FormatError(text.format(instance.tag, url))
        return self._by_id[url[1:]]

    def _add_node(self, node: Element, above: np.ndarray, depth: int) -> None:
        check_depth(depth)
        place = above
        for child in node:
            if child.tag in _TRANSFORMS:
                place = place @ _TRANSFORMS[child.tag](_expected_numbers(child))
        for child in node:
            if child.tag == "node":
                self._add_node(child, place, depth + 1)
            elif child.tag == "instance_node":
                self._add_node(self._referred(child), place, depth + 1)
            elif child.tag in ("instance_geometry", "instance_controller"):
                self._assembly.add(self._geometry(self._shape(child)), place)

    def _shape(self, instance: Element) -> Element:
        """The geometry of an instance, behind any controllers."""
        shape = self._referred(instance)
        for _ in range(10):
            if shape.tag != "controller":
                break
            for modifier in children(shape, "skin", "morph"):
                shape = self._referred(
                    Element(modifier.tag, {"url": modifier.attrib.get("source", "")})
                )
        return shape

    def _geometry(self, geometry: Element) -> RawMesh:
        key = geometry.attrib.get("id", str(id(geometry)))
        if key not in self._meshes:
            self._meshes[key] = geometry_mesh(geometry)
        return self._meshes[key]


def _translation(numbers: np.ndarray) -> np.ndarray:
    matrix = np.eye(4)
    matrix[:3, 3] = numbers
    return matrix


def _rotation(numbers: np.ndarray) -> np.ndarray:
    """Of an angle [degree] about an axis."""
    matrix = np.eye(4)
    length = np.linalg.norm(numbers[:3])
    if length > 0.0:
        x, y, z = numbers[:3] / length
        turn = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
        angle = np.radians(numbers[3])
        matrix[:3, :3] += np.sin(angle) * turn + (1.0 - np.cos(angle)) * turn @ turn
    return matrix


def _look_at(numbers: np.ndarray) -> np.ndarray:
    eye, target, up = numbers.reshape(3, 3)
    back = eye - target
    with np.errstate(all="ignore"):
        back = back / np.linalg.norm(back)
        right = np.cross(up, back)
        right = right / np.linalg.norm(right)
    matrix = np.eye(4)
    matrix[:3] = np.stack((right, np.cross(back, right), back, eye), axis=1)
    return matrix


_TRANSFORMS = {
    "matrix": lambda numbers: numbers.reshape(4, 4),
    "translate": _translation,
    "rotate": _rotation,
    "scale": lambda numbers: np.diag([*numbers, 1.0]),
    "lookat": _look_at,
}
_NUMBERS = {"matrix": 16, "translate": 3, "rotate": 4, "scale": 3, "lookat": 9}


def _expected_numbers(element: Element) -> np.ndarray:
    numbers = text_numbers(element)
    if len(numbers) != _NUMBERS[element.tag]:
        text = "<{}> holds {} numbers, not {}"
        raise FormatError(text.format(element.tag, len(numbers), _NUMBERS[element.tag]))
    return numbers
