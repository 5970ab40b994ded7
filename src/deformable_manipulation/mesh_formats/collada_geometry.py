"""A geometry of COLLADA."""

from typing import Dict, List, Tuple

import numpy as np

from deformable_manipulation.mesh_formats.faces import (
    FormatError,
    RawMesh,
    fans,
    strips,
    triangulated,
)
from deformable_manipulation.mesh_formats.parts import check_range
from deformable_manipulation.mesh_formats.xml_tree import Element, children, text_numbers

_SURFACES = ("triangles", "polylist", "polygons", "tristrips", "trifans")


def geometry_mesh(geometry: Element) -> RawMesh:
    """Vertices, in the units of the file, and triangles; lines and splines are passed over.

    Raises:
        FormatError: with the name of the geometry.
    """
    name = geometry.attrib.get("name") or geometry.attrib.get("id", "")
    try:
        return _mesh(geometry)
    except FormatError as error:
        raise FormatError("geometry '{}': {}".format(name, error)) from None


def _mesh(geometry: Element) -> RawMesh:
    mesh = geometry.find("mesh")
    if mesh is None:
        mesh = geometry.find("convex_mesh")
    vertices = [np.empty((0, 3))]
    triangles = [np.empty((0, 3), dtype=np.int64)]
    begins: Dict[str, int] = {}  # of the positions of a source in the vertices
    for surface in children(mesh, *_SURFACES):
        runs, source = _runs(surface, geometry)
        if source not in begins:
            begins[source] = sum(map(len, vertices))
            vertices.append(_positions(geometry, source))
        corners = np.concatenate([np.empty(0, dtype=np.int64), *runs])
        count = sum(map(len, vertices)) - begins[source]
        check_range(corners, count, "<{}>".format(surface.tag))
        places = [run + begins[source] for run in runs]
        triangles.append(_triangles(surface.tag, np.concatenate(vertices), places))
    return RawMesh(np.concatenate(vertices), np.concatenate(triangles))


def _triangles(tag: str, vertices: np.ndarray, runs: List[np.ndarray]) -> np.ndarray:
    if tag == "tristrips":
        return strips([run for run in runs if len(run) >= 3])
    if tag == "trifans":
        return fans(runs)
    counts = np.array([len(run) for run in runs], dtype=np.int64)
    corners = np.concatenate([np.empty(0, dtype=np.int64), *runs])
    return triangulated(vertices, counts, corners)


def _runs(surface: Element, geometry: Element) -> Tuple[List[np.ndarray], str]:
    """Indices of positions of each face, strip or fan, and the source of the positions."""
    inputs = list(children(surface, "input"))
    offsets = [int(each.attrib.get("offset", 0)) for each in inputs]
    places = [
        (offset, each.attrib.get("source", "")[1:])
        for offset, each in zip(offsets, inputs)
        if each.attrib.get("semantic") == "VERTEX"
    ]
    if not places:
        raise FormatError("<{}> has no input of vertices".format(surface.tag))
    offset, source = places[0]
    step = max(offsets) + 1
    if surface.find("ph") is not None:
        raise FormatError("<polygons> has faces with holes (<ph>); triangulate it on export")
    lists = [text_numbers(each, np.int64)[offset::step] for each in children(surface, "p")]
    if surface.tag == "triangles":
        flat = np.concatenate([np.empty(0, dtype=np.int64), *lists])
        return list(flat[: len(flat) // 3 * 3].reshape(-1, 3)), source
    if surface.tag == "polylist":
        flat = np.concatenate([np.empty(0, dtype=np.int64), *lists])
        length = surface.find("vcount")
        counts = text_numbers(length, np.int64) if length is not None else np.empty(0, np.int64)
        if counts.sum() > len(flat) or (counts < 0).any():
            text = "<vcount> tells of {} corners, and <p> holds {}"
            raise FormatError(text.format(counts.sum(), len(flat)))
        return np.split(flat, np.cumsum(counts))[:-1], source
    return lists, source


def _positions(geometry: Element, vertices_id: str) -> np.ndarray:
    """Positions (V, 3) of <vertices>."""
    sources = {each.attrib.get("id", ""): each for each in geometry.iter() if "id" in each.attrib}
    vertices = sources.get(vertices_id)
    for each in children(vertices, "input"):
        if each.attrib.get("semantic") == "POSITION":
            source = sources.get(each.attrib.get("source", "")[1:])
            return _floats(source)
    raise FormatError("its vertices have no positions")


def _floats(source) -> np.ndarray:
    array = None if source is None else source.find("float_array")
    if array is None:
        raise FormatError("its positions are not in the file")
    numbers = text_numbers(array)
    accessor = source.find("technique_common/accessor")
    settings = {} if accessor is None else accessor.attrib
    stride = int(settings.get("stride", 3))
    numbers = numbers[int(settings.get("offset", 0)) :]
    if stride < 3:
        raise FormatError("its positions have {} coordinates, not 3".format(stride))
    rows = (len(numbers) + stride - 3) // stride
    numbers = np.concatenate((numbers, np.zeros(stride)))[: rows * stride]
    return numbers.reshape(rows, stride)[:, :3]
