"""Wavefront OBJ."""

import re
from typing import List

import numpy as np

from deformable_manipulation.mesh_formats.faces import FormatError, RawMesh, triangulated
from deformable_manipulation.mesh_formats.numbers_in_text import decoded, shown, vertices_of

_INDEX = re.compile(r"[+-]?[0-9]+(/|$)")
_NOT_YET = "line {}: a face names vertex {}, and only {} vertices stand before it"
_ABSENT = "line {}: a face names vertex {}, and there are {} vertices"


def read(data: bytes) -> RawMesh:
    """Vertices and faces of all groups and objects; curves, points and materials are passed over.

    Raises:
        FormatError: with the line.
    """
    rows: List[List[str]] = []
    row_lines, corners, counts, face_lines = [], [], [], []
    kinds = set()
    text = decoded(data).replace("\\\r\n", " ").replace("\\\n", " ")
    for line, content in enumerate(text.splitlines(), start=1):
        words = content.partition("#")[0].split()
        if not words:
            continue
        if words[0] == "v":
            rows.append(words[1:4])
            row_lines.append(line)
        elif words[0] in ("f", "fo"):
            face = _corners(words[1:], len(rows), line)
            corners += face
            counts.append(len(face))
            face_lines.append(line)
        else:
            kinds.add(words[0])
    if not counts:
        raise FormatError(_without_faces(kinds))
    vertices = vertices_of(rows, row_lines)
    flat, sizes = np.array(corners, dtype=np.int64), np.array(counts, dtype=np.int64)
    absent = flat >= len(vertices)
    if absent.any():
        at = int(np.argmax(absent))
        line = face_lines[int(np.searchsorted(np.cumsum(sizes), at, side="right"))]
        raise FormatError(_ABSENT.format(line, flat[at] + 1, len(vertices)))
    return RawMesh(vertices, triangulated(vertices, sizes, flat))


def _corners(words: List[str], known: int, line: int) -> List[int]:
    """Indices, from 0, of the corners ``vertex/texture/normal`` of a face.

    A negative index counts back from the line: -1 is the last of the ``known`` vertices.
    """
    try:
        indices = [int(word.partition("/")[0]) for word in words]
    except ValueError:
        wrong = next(word for word in words if not _INDEX.match(word))
        raise FormatError("line {}: {} is no corner of a face".format(line, shown(wrong))) from None
    if indices and min(indices) > 0:
        return [index - 1 for index in indices]
    if 0 in indices:
        raise FormatError("line {}: a face names vertex 0; OBJ counts vertices from 1".format(line))
    if indices and -min(indices) > known:
        raise FormatError(_NOT_YET.format(line, min(indices), known))
    return [index - 1 if index > 0 else known + index for index in indices]


def _without_faces(kinds: set) -> str:
    if kinds & {"curv", "curv2", "surf"}:
        return "it holds free-form curves or surfaces and no faces; export it as polygons"
    if kinds & {"l", "p"}:
        return "there are no triangles in it, only lines or points"
    return "there are no triangles in it: no line begins with 'f'"
