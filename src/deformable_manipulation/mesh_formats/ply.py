"""Stanford PLY, text and binary."""

from typing import Any, Dict, List, NamedTuple, Tuple, Union

import numpy as np

from deformable_manipulation.mesh_formats.faces import (
    FormatError,
    RawMesh,
    strips,
    triangulated,
)
from deformable_manipulation.mesh_formats.numbers_in_text import shown
from deformable_manipulation.mesh_formats.ply_values import BinaryValues, TextValues

_TYPES = {
    **{"char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4"},
    **{"float": "f4", "double": "f8", "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2"},
    **{"int32": "i4", "uint32": "u4", "float32": "f4", "float64": "f8", "half": "f2"},
    **{"int64": "i8", "uint64": "u8"},
}
_ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
_INDICES = ("vertex_indices", "vertex_index")


class _Property(NamedTuple):
    name: str
    type: str  # of numpy
    count_type: str  # of the length of a list; empty: a single value


class _Element(NamedTuple):
    name: str
    size: int
    properties: List[_Property]


def read(data: bytes) -> RawMesh:
    """Vertices, faces and triangle strips; other elements are passed over.

    Raises:
        FormatError: with the line of the header, or the element.
    """
    found = _read_elements(data)
    vertices = _vertices(found.get("vertex", {}))
    triangles = []
    if "face" in found:
        counts, corners = _indices(found["face"], "face")
        _check_indices(counts, corners, len(vertices), "face")
        triangles.append(triangulated(vertices, counts, corners))
    if "tristrips" in found:
        counts, corners = _indices(found["tristrips"], "tristrips")
        _check_indices(counts, np.maximum(corners, 0), len(vertices), "strip")
        triangles.append(strips(_runs(counts, corners)))
    if not triangles:
        raise FormatError("there are no triangles in it: it has vertices and no faces")
    return RawMesh(vertices, np.concatenate(triangles))


def read_points(data: bytes) -> np.ndarray:
    """The vertices (N, 3) alone. Raises FormatError as :func:`read` does."""
    return _vertices(_read_elements(data).get("vertex", {}))


def _read_elements(data: bytes) -> Dict[str, Any]:
    """The properties of each element by name."""
    elements, order, begin = _header(data)
    values = BinaryValues(data, begin, order) if order else TextValues(data, begin)
    return {element.name: _read_element(values, element) for element in elements}


def _header(data: bytes) -> Tuple[List[_Element], str, int]:
    """The elements, the order of bytes (empty: text) and where their values begin."""
    elements: List[_Element] = []
    order = None
    place = 0
    if data[:4].strip() != b"ply" and data[:3] != b"ply":
        raise FormatError("it is no PLY file, which begins with a line 'ply'")
    for number in range(1, data.count(b"\n", 0, 1 << 16) + 2):
        end = data.find(b"\n", place)
        if end < 0:
            break
        line = data[place:end].decode("latin-1")
        place = end + 1
        words = line.split()
        if words[:1] == ["end_header"]:
            if order is None:
                raise FormatError("its header has no line 'format'")
            return elements, order, place
        try:
            if words[:1] == ["format"]:
                order = _ORDERS[words[1]]
            elif words[:1] == ["element"]:
                elements.append(_Element(words[1], int(words[2]), []))
            elif words[:1] == ["property"]:
                elements[-1].properties.append(_property(words[1:]))
        except (KeyError, IndexError, ValueError):
            text = "line {} of its header, {}, cannot be understood"
            raise FormatError(text.format(number, shown(line))) from None
    raise FormatError("its header has no end, a line 'end_header'")


def _property(words: List[str]) -> _Property:
    if words[0] == "list":
        return _Property(words[3], _TYPES[words[2]], _TYPES[words[1]])
    return _Property(words[1], _TYPES[words[0]], "")


def _read_element(values: Union[BinaryValues, TextValues], element: _Element) -> Dict[str, Any]:
    """The properties by name: values (N,), of lists lengths (N,) and values (sum of lengths,)."""
    kinds = [(each.type, each.count_type) for each in element.properties]
    if not kinds:
        return {}
    try:
        columns = values.read(element.size, kinds)
    except EOFError as error:
        text = "the file ends in element '{}' {} of {}; it is cut off, or its header is wrong"
        raise FormatError(text.format(element.name, error, element.size)) from None
    return {each.name: column for each, column in zip(element.properties, columns)}


def _vertices(columns: Dict[str, Any]) -> np.ndarray:
    missing = [axis for axis in "xyz" if not isinstance(columns.get(axis), np.ndarray)]
    if missing:
        raise FormatError("its vertices have no property {}".format(", ".join(missing)))
    return np.stack([columns[axis] for axis in "xyz"], axis=1).astype(float)


def _indices(columns: Dict[str, Any], element: str) -> Tuple[np.ndarray, np.ndarray]:
    """Lengths and values of the lists of vertices."""
    for name in _INDICES:
        if isinstance(columns.get(name), tuple):
            counts, corners = columns[name]
            return counts.astype(np.int64), corners.astype(np.int64)
    raise FormatError("its element '{}' has no list vertex_indices".format(element))


def _check_indices(counts: np.ndarray, corners: np.ndarray, vertices: int, thing: str) -> None:
    wrong = (corners < 0) | (corners >= vertices)
    if wrong.any():
        at = int(np.argmax(wrong))
        text = "{} {} names vertex {}; the {} vertices are counted from 0"
        owner = int(np.searchsorted(np.cumsum(counts), at, side="right"))
        raise FormatError(text.format(thing, owner, corners[at], vertices))


def _runs(counts: np.ndarray, corners: np.ndarray) -> List[np.ndarray]:
    """The strips; -1 ends one of them and begins the next."""
    lists = np.split(corners, np.cumsum(counts)[:-1])
    return [
        run[run >= 0]
        for each in lists
        for run in np.split(each, np.flatnonzero(each < 0))
        if np.count_nonzero(run >= 0) >= 3
    ]
