"""Triangle meshes: reading them from files."""

import io
import re
from pathlib import Path
from typing import Any, Dict, Tuple

import numpy as np

from deformable_manipulation.system.interruption import check_interruption
from deformable_manipulation.system.text_files import TextFileError, read_bytes

LARGEST_COORDINATE = 1e6  # m
LARGEST_FILE = 1_000_000_000  # bytes, some million triangles in the most verbose format
FORMATS = "OBJ, PLY, STL, OFF, glTF and GLB"
_SETTINGS: Dict[str, Any] = dict(process=False, maintain_order=True, skip_materials=True)
_ZERO = re.compile(rb"[ \t]0+(?=[/\s]|$)")


class MeshError(ValueError):
    """A mesh cannot be read or has no triangles; the message says why, on one line."""


def read_mesh(path) -> Tuple[np.ndarray, np.ndarray]:
    """Read a mesh in any format that Trimesh reads: OBJ, PLY, STL, OFF, glTF and others.

    The parts of a scene are merged, where they are placed. Vertices at the same place are one;
    those that no triangle has are left out; the others keep the file's order.

    Returns:
        vertices (V, 3) [units of the file] and triangles (T, 3), indices of vertices.

    Raises:
        MeshError: the file, which it names, cannot be read, is no regular file, has more than
            LARGEST_FILE bytes, is of no known format or broken, has no triangles (a point cloud),
            or has coordinates that are not finite or beyond LARGEST_COORDINATE.
    """
    try:
        data = read_bytes(path, LARGEST_FILE)
    except TextFileError as error:
        raise MeshError("{} {}".format(path, error)) from error
    if not data:
        raise MeshError("{} is empty".format(path))
    vertices, triangles = _parsed(path, data)
    vertices, triangles = np.asarray(vertices, dtype=float), np.asarray(triangles)
    fault = _fault(vertices, triangles)
    if fault:
        raise MeshError("{}: {}".format(path, fault))
    return _merged(vertices, triangles.astype(np.int64))


def scaled_mesh(spec) -> Tuple[np.ndarray, np.ndarray]:
    """Vertices [m] of the obstacle's own frame, and triangles, of a scenario.spec.MeshObstacle.

    Raises:
        MeshError: as of read_mesh.
    """
    vertices, triangles = read_mesh(spec.mesh)
    return vertices * np.asarray(spec.scale, dtype=float), triangles


def _parsed(path, data: bytes) -> Tuple[np.ndarray, np.ndarray]:
    try:
        import trimesh  # takes long to import, and not every run needs it
    except ImportError as error:
        check_interruption()
        raise MeshError("{}: meshes need the Python package trimesh".format(path)) from error
    check_interruption()  # which Trimesh keeps to itself
    suffix = Path(str(path)).suffix.lower().lstrip(".")
    if suffix not in trimesh.available_formats():
        raise MeshError(
            "{}: '{}' is no format of meshes that can be read; formats allowed: {}".format(
                path, suffix, FORMATS
            )
        )
    if suffix == "obj" and _has_face_of_vertex_0(data):
        raise MeshError("{}: a face names vertex 0; OBJ counts vertices from 1".format(path))
    resolver = trimesh.resolvers.FilePathResolver(str(path))
    try:
        scene = trimesh.load_scene(io.BytesIO(data), suffix, resolver=resolver, **_SETTINGS)
        mesh = scene.to_mesh()
        return mesh.vertices, mesh.faces
    except Exception as error:  # whatever the parser of this format stumbles over
        raise MeshError(
            "{} is no mesh that can be read: it is broken, or no {} file; formats allowed: "
            "{}".format(path, suffix.upper(), FORMATS)
        ) from error


def _has_face_of_vertex_0(data: bytes) -> bool:
    """Whether a face of an OBJ file names vertex 0, which Trimesh takes for the last one."""
    for zero in _ZERO.finditer(data):
        line = data[data.rfind(b"\n", 0, zero.start()) + 1 : zero.start()]
        if line.split(None, 1)[:1] == [b"f"] and b"#" not in line:
            return True
    return False


def _fault(vertices: np.ndarray, triangles: np.ndarray) -> str:
    """Why there is no mesh; empty if there is one."""
    if triangles.ndim != 2 or triangles.shape[1:] != (3,) or not len(triangles):
        return "there are no triangles in it"
    outside = ~(np.abs(vertices) <= LARGEST_COORDINATE).all(axis=1)
    if outside.any():
        index = int(np.argmax(outside))
        text = "vertex {} is ({:g}, {:g}, {:g}); coordinates must be finite and at most {:g}"
        return text.format(index, *vertices[index], LARGEST_COORDINATE)
    if triangles.min() < 0 or triangles.max() >= len(vertices):
        return "a triangle refers to a vertex that there is not"
    first, second, third = np.moveaxis(vertices[triangles], 1, 0)
    if not np.cross(second - first, third - first).any():
        return "no triangle in it has an area"
    return ""


def _merged(vertices: np.ndarray, triangles: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
    used = np.zeros(len(vertices), dtype=bool)
    used[triangles] = True
    renumbered = np.cumsum(used) - 1
    vertices, triangles = vertices[used], renumbered[triangles]
    first, same_as = _distinct(vertices + 0.0)  # -0 becomes 0
    order = np.argsort(first, kind="stable")
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    return np.ascontiguousarray(vertices[first[order]]), rank[same_as][triangles]


def _distinct(rows: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
    """First index of each distinct row, and which of them each row is."""
    factors = np.array(
        [0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9], dtype=np.uint64
    )
    bits = np.ascontiguousarray(rows).view(np.uint64)
    mixed = (bits ^ (bits >> np.uint64(31))) * factors
    keys = np.bitwise_xor.reduce(mixed ^ (mixed >> np.uint64(29)), axis=1)
    _, first, same_as = np.unique(keys, return_index=True, return_inverse=True)
    if not np.array_equal(rows[first][same_as], rows):  # two rows with the same key
        _, first, same_as = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    return first, same_as.ravel()
