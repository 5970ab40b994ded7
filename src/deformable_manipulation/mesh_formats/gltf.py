"""The scene of glTF 2.0 and GLB files."""

from typing import Any, Dict, List, Set

import numpy as np

from deformable_manipulation.mesh_formats.faces import FormatError, RawMesh, fans, strips
from deformable_manipulation.mesh_formats.gltf_values import GltfFile, item_of
from deformable_manipulation.mesh_formats.parts import Assembly, check_depth, check_range

_TRIANGLES, _STRIP, _FAN = 4, 5, 6
_PACKING = {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression"}


def read(data: bytes, path: str) -> RawMesh:
    """The meshes [m] of the scene, where its nodes place them.

    Points and lines are passed over; what is skinned or morphed has the shape of its mesh.

    Args:
        data: the file; of GLB if it begins with 'glTF'.
        path: of the file, beside which others are that it names.

    Raises:
        FormatError: with what is wrong.
    """
    return _Scene(GltfFile(data, path)).mesh()


class _Scene:
    def __init__(self, file: GltfFile):
        self._file = file
        self._document = file.document
        self._meshes: Dict[int, RawMesh] = {}
        self._assembly = Assembly()
        packed = _PACKING & set(self._document.get("extensionsRequired", ()))
        if packed:
            text = "it uses {}; export it without compression"
            raise FormatError(text.format(", ".join(sorted(packed))))

    def mesh(self) -> RawMesh:
        for node in self._roots():
            self._add_node(node, np.eye(4), 0)
        return self._assembly.mesh(1.0)

    def _roots(self) -> List[int]:
        """The nodes of the scene that is shown, or else of the first, or else those of no other."""
        if self._document.get("scenes"):
            scene = item_of(self._document, "scenes", self._document.get("scene", 0), "its scene")
            return scene.get("nodes", [])
        nodes = self._document.get("nodes", [])
        below: Set[int] = {child for node in nodes for child in node.get("children", ())}
        return [index for index in range(len(nodes)) if index not in below]

    def _add_node(self, index: int, above: np.ndarray, depth: int) -> None:
        check_depth(depth)
        node = item_of(self._document, "nodes", index, "a scene or node")
        place = above @ _placement(node)
        if "mesh" in node:
            self._assembly.add(self._mesh(node["mesh"]), place)
        for child in node.get("children", ()):
            self._add_node(child, place, depth + 1)

    def _mesh(self, index: int) -> RawMesh:
        if index not in self._meshes:
            mesh = item_of(self._document, "meshes", index, "a node")
            try:
                self._meshes[index] = self._merged(mesh.get("primitives", ()))
            except FormatError as error:
                name = mesh.get("name", index)
                raise FormatError("mesh '{}': {}".format(name, error)) from None
        return self._meshes[index]

    def _merged(self, primitives) -> RawMesh:
        vertices = [np.empty((0, 3))]
        triangles = [np.empty((0, 3), dtype=np.int64)]
        for primitive in primitives:
            mode = primitive.get("mode", _TRIANGLES)
            if mode in (_TRIANGLES, _STRIP, _FAN) and "POSITION" in primitive["attributes"]:
                own = self._file.accessor(primitive["attributes"]["POSITION"], "VEC3")
                triangles.append(
                    self._triangles(primitive, mode, len(own)) + sum(map(len, vertices))
                )
                vertices.append(own.astype(float))
        return RawMesh(np.concatenate(vertices), np.concatenate(triangles))

    def _triangles(self, primitive: Dict[str, Any], mode: int, vertices: int) -> np.ndarray:
        corners = np.arange(vertices, dtype=np.int64)
        if "indices" in primitive:
            corners = self._file.accessor(primitive["indices"], "SCALAR").reshape(-1)
            corners = corners.astype(np.int64)
            check_range(corners, vertices, "its triangles")
        if mode == _STRIP:
            return strips([corners] if len(corners) >= 3 else [])
        if mode == _FAN:
            return fans([corners])
        return corners[: len(corners) // 3 * 3].reshape(-1, 3)


def _placement(node: Dict[str, Any]) -> np.ndarray:
    """The matrix (4, 4) of column vectors of a node."""
    if "matrix" in node:
        return np.array(node["matrix"], dtype=float).reshape(4, 4).T
    matrix = np.eye(4)
    x, y, z, w = node.get("rotation", (0.0, 0.0, 0.0, 1.0))
    length = float(np.linalg.norm((x, y, z, w)))
    if length > 0.0:
        x, y, z, w = x / length, y / length, z / length, w / length
        cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
        matrix[:3, :3] += 2.0 * w * cross + 2.0 * cross @ cross
    matrix[:3, :3] *= np.array(node.get("scale", (1.0, 1.0, 1.0)), dtype=float)
    matrix[:3, 3] = node.get("translation", (0.0, 0.0, 0.0))
    return matrix
