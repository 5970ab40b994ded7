"""STL, binary and text."""

import numpy as np

from deformable_manipulation.mesh_formats.faces import FormatError, RawMesh
from deformable_manipulation.mesh_formats.numbers_in_text import decoded, shown, vertices_of

_HEADER = 84  # bytes, the number of triangles last
_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def read(data: bytes) -> RawMesh:
    """The triangles of all solids, each with three vertices of its own.

    Raises:
        FormatError: with the line of a text.
    """
    room = (len(data) - _HEADER) // _TRIANGLE.itemsize
    told = int(np.frombuffer(data[80:84], dtype="<u4")[0]) if len(data) >= _HEADER else -1
    # Headers of binary files may begin with 'solid', too; texts hold no zero bytes.
    begin = data[:512]
    if begin.lstrip().lower().startswith(b"solid") and b"\0" not in begin:
        corners = _text_corners(data)
    elif told < 0:
        raise FormatError(
            "it is no STL file: its text does not begin with 'solid', and it is too short for a "
            "binary one"
        )
    elif told > room:
        text = "it tells of {} triangles and has room for {}; it is cut off, or no STL file"
        raise FormatError(text.format(told, max(room, 0)))
    else:
        triangles = np.frombuffer(data, dtype=_TRIANGLE, count=told, offset=_HEADER)
        corners = triangles["corners"].reshape(-1, 3).astype(float)
    return RawMesh(corners, np.arange(len(corners), dtype=np.int64).reshape(-1, 3))


def _text_corners(data: bytes) -> np.ndarray:
    """Corners (3 T, 3) of the triangles of a text."""
    rows, lines = [], []
    begun = 0  # line of the facet that is open; 0: none is
    for number, line in enumerate(decoded(data).splitlines(), start=1):
        words = line.split()
        keyword = words[0].lower() if words else ""
        if keyword == "vertex":
            rows.append(words[1:4])
            lines.append(number)
        elif keyword == "facet":
            begun = number
        elif keyword == "endfacet":
            if len(rows) % 3:
                text = "line {}: the facet that begins here has not three lines 'vertex x y z'"
                raise FormatError(text.format(begun or number))
            begun = 0
        elif keyword not in ("", "outer", "endloop", "endsolid", "solid", "end") and begun:
            raise FormatError("line {}: {} is none of STL".format(number, shown(line)))
    if begun or len(rows) % 3:
        text = "the file ends within the facet that begins on line {}; it is cut off"
        raise FormatError(text.format(begun))
    return vertices_of(rows, lines)
