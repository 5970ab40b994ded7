"""Triangle meshes: reading them from files."""

from pathlib import Path
from typing import Callable, Dict, Sequence, Tuple

import numpy as np

from deformable_manipulation.geometry.mesh_mending import MendedMesh, mended, without_unused
from deformable_manipulation.mesh_formats import (
    collada,
    library,
    obj,
    off,
    ply,
    stl,
    three_mf,
)
from deformable_manipulation.mesh_formats.faces import FormatError, RawMesh, without_collapsed
from deformable_manipulation.mesh_formats.packed import unpacked
from deformable_manipulation.system.text_files import TextFileError, read_bytes

LARGEST_COORDINATE = 1e6  # m
LARGEST_FILE = 1_000_000_000  # bytes, some million triangles in the most verbose format
FORMATS = "OBJ, PLY, STL, OFF, COLLADA (.dae), 3MF, glTF and GLB, also packed as .gz or .zip"
_NO_ORIGIN = (0.0, 0.0, 0.0)
_READERS: Dict[str, Callable[[bytes], RawMesh]] = {
    "obj": obj.read,
    "off": off.read,
    "ply": ply.read,
    "stl": stl.read,
    "dae": collada.read,
    "3mf": lambda data: three_mf.read(data, LARGEST_FILE),
}


class MeshError(ValueError):
    """A mesh cannot be read or has no triangles; the message says why, on one line."""


def read_mesh(path, origin: Sequence[float] = _NO_ORIGIN) -> Tuple[np.ndarray, np.ndarray]:
    """Vertices and triangles of :func:`read_mended_mesh`."""
    mesh = read_mended_mesh(path, origin)
    return mesh.vertices, mesh.triangles


def read_mended_mesh(path, origin: Sequence[float] = _NO_ORIGIN) -> MendedMesh:
    """Read a mesh of one of FORMATS, or another one that Trimesh reads.

    The parts of a scene are merged, where they are placed. Faces of more than three corners are
    triangulated. Vertices at the same place are one; those that no triangle has are left out; the
    others keep the file's order. What does not quite meet is mended
    (:func:`.mesh_mending.mended`).

    Args:
        path: of the file.
        origin: (3,) what is taken off all coordinates [units of the result].

    Returns:
        Its vertices (V, 3) are in the units of the file; those of COLLADA and 3MF, which tell
        their unit, in m.

    Raises:
        MeshError: the file, which it names, cannot be read, is no regular file, has more than
            LARGEST_FILE bytes, is of no known format or broken, has no triangles (a point cloud),
            or has coordinates that are not finite or, from the origin, beyond LARGEST_COORDINATE.
    """
    try:
        data = read_bytes(path, LARGEST_FILE)
    except TextFileError as error:
        raise MeshError("{} {}".format(path, error)) from error
    if not data:
        raise MeshError("{} is empty".format(path))
    try:
        with np.errstate(all="ignore"):  # coordinates that are no numbers are refused below
            raw = _parsed(str(path), data)
    except FormatError as error:
        raise MeshError("{}: {}".format(path, " ".join(str(error).split()))) from error
    except Exception as error:  # a broken file may break a rule that no reader thought of
        text = "{} is no mesh that can be read: it is broken; formats allowed: {}"
        raise MeshError(text.format(path, FORMATS)) from error
    vertices = np.asarray(raw.vertices, dtype=float)
    fault = _fault(vertices, raw.triangles, np.asarray(origin, dtype=float))
    if fault:
        raise MeshError("{}: {}".format(path, fault))
    return mended(*_merged(vertices - origin, raw.triangles.astype(np.int64)))


def scaled_mesh(spec) -> Tuple[np.ndarray, np.ndarray]:
    """Vertices and triangles of :func:`scaled_mended_mesh`."""
    mesh = scaled_mended_mesh(spec)
    return mesh.vertices, mesh.triangles


def scaled_mended_mesh(spec) -> MendedMesh:
    """The mesh of a scenario.spec.MeshObstacle, its vertices [m] of the obstacle's own frame.

    Raises:
        MeshError: as of read_mended_mesh.
    """
    mesh = read_mended_mesh(spec.mesh, spec.origin)
    return mesh._replace(vertices=mesh.vertices * np.asarray(spec.scale, dtype=float))


def _parsed(path: str, data: bytes) -> RawMesh:
    name, data = unpacked(path, data, LARGEST_FILE, _is_mesh)
    suffix = _suffix(name)
    if suffix in _READERS:
        return _READERS[suffix](data)
    if suffix not in library.formats():
        text = "'{}' is no format of meshes that can be read; formats allowed: {}"
        raise FormatError(text.format(suffix, FORMATS))
    return library.read(data, suffix, path)


def _suffix(name: str) -> str:
    return Path(name).suffix.lower().lstrip(".")


def _is_mesh(name: str) -> bool:
    return _suffix(name) in (*_READERS, "gltf", "glb")


def _fault(vertices: np.ndarray, triangles: np.ndarray, origin: np.ndarray) -> str:
    """Why there is no mesh; empty if there is one."""
    if triangles.ndim != 2 or triangles.shape[1:] != (3,) or not len(triangles):
        return "there are no triangles in it"
    if triangles.min() < 0 or triangles.max() >= len(vertices):
        return "a triangle refers to a vertex that there is not"
    outside = ~(np.abs(vertices - origin) <= LARGEST_COORDINATE).all(axis=1)
    if outside.any():
        index = int(np.argmax(outside))
        text = (
            "vertex {} is ({:g}, {:g}, {:g}); coordinates must be finite and at most {:g} from the "
            "origin"
        )
        return text.format(index, *vertices[index], LARGEST_COORDINATE)
    first, second, third = np.moveaxis(vertices[triangles], 1, 0)
    if not np.cross(second - first, third - first).any():
        return "no triangle in it has an area"
    return ""


def _merged(vertices: np.ndarray, triangles: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
    vertices, triangles = without_unused(vertices, triangles)
    first, same_as = _distinct(vertices + 0.0)  # -0 becomes 0
    order = np.argsort(first, kind="stable")
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    return np.ascontiguousarray(vertices[first[order]]), without_collapsed(rank[same_as][triangles])


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
