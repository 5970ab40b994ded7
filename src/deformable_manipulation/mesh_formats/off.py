"""Object File Format (OFF) as text."""

import re
from typing import Iterator, List, Tuple

import numpy as np

from deformable_manipulation.mesh_formats.faces import FormatError, RawMesh, triangulated
from deformable_manipulation.mesh_formats.numbers_in_text import (
    content_lines,
    decoded,
    shown,
    vertices_of,
)

_HEADER = re.compile(r"(ST)?C?N?OFF|(?=[0-9])")  # the word may be absent


def read(data: bytes) -> RawMesh:
    """Vertices and faces; colours, normals and texture coordinates are passed over.

    Raises:
        FormatError: with the line.
    """
    lines = content_lines(decoded(data))
    vertex_count, face_count = _counts(lines)
    rows, row_lines = _rows(lines, vertex_count, "vertices")
    vertices = vertices_of([row[:3] for row in rows], row_lines)
    indices = [_face(lines, place, face_count, vertex_count) for place in range(face_count)]
    counts = np.array([len(face) for face in indices], dtype=np.int64)
    corners = np.array([index for face in indices for index in face], dtype=np.int64)
    return RawMesh(vertices, triangulated(vertices, counts, corners))


def _counts(lines: Iterator[Tuple[int, str]]) -> Tuple[int, int]:
    """Numbers of vertices and faces, on the line of the header or the next."""
    number, content = next(lines, (1, ""))
    header = _HEADER.match(content)
    if header is None or "BINARY" in content:
        text = "line {}: {} is no header of an OFF file of text; it begins with OFF"
        raise FormatError(text.format(number, shown(content)))
    words = content[header.end() :].split()
    if not words:
        number, content = next(lines, (number, ""))
        words = content.split()
    try:
        return int(words[0]), int(words[1])
    except (ValueError, IndexError):
        text = "line {}: {} are not the numbers of vertices, faces and edges"
        raise FormatError(text.format(number, shown(content))) from None


def _rows(
    lines: Iterator[Tuple[int, str]], count: int, things: str
) -> Tuple[List[List[str]], List[int]]:
    """The words of the next lines, and their numbers."""
    rows, numbers = [], []
    for _ in range(count):
        number, content = next(lines, (0, ""))
        if not content:
            text = "the file ends after {} of {} {}; it is cut off, or its header is wrong"
            raise FormatError(text.format(len(rows), count, things))
        rows.append(content.split())
        numbers.append(number)
    return rows, numbers


def _face(lines: Iterator[Tuple[int, str]], place: int, faces: int, vertices: int) -> List[int]:
    """The vertices of a face, which may go on on the next lines."""
    words: List[str] = []
    line, count = 0, 1
    while len(words) <= count:
        number, content = next(lines, (0, ""))
        if not content:
            text = "the file ends in face {} of {}; it is cut off, or its header is wrong"
            raise FormatError(text.format(place + 1, faces))
        line = line or number
        words += content.split()
        count = int(words[0]) if words[0].isdigit() else -1
    try:
        face = [int(word) for word in words[1 : count + 1]]
    except ValueError:
        face = []
    if len(face) != count:
        text = "line {}: {} is no face: the number of its corners, then so many vertices"
        raise FormatError(text.format(line, shown(" ".join(words))))
    for index in face:
        if not 0 <= index < vertices:
            text = "line {}: a face names vertex {}; the {} vertices are counted from 0"
            raise FormatError(text.format(line, index, vertices))
    return face
