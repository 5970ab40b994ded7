"""Meshes that are put together of placed parts."""

from typing import List, Tuple

import numpy as np

from deformable_manipulation.mesh_formats.faces import FormatError, RawMesh

LARGEST_PART_COUNT = 100_000  # placed parts of one file
LARGEST_DEPTH = 100  # of parts within parts, which may name one another in a circle


class Assembly:
    """Placed parts, made into one mesh."""

    def __init__(self) -> None:
        self._parts: List[Tuple[np.ndarray, np.ndarray]] = []
        self._vertex_count = 0

    def add(self, mesh: RawMesh, placement: np.ndarray) -> None:
        """Put a part where a matrix (4, 4) of column vectors places it.

        One that reflects it turns its triangles, so that they face outwards as before.
        """
        if len(self._parts) >= LARGEST_PART_COUNT:
            raise FormatError("it places more than {} parts".format(LARGEST_PART_COUNT))
        vertices = mesh.vertices @ placement[:3, :3].T + placement[:3, 3]
        triangles = mesh.triangles + self._vertex_count
        if np.linalg.det(placement[:3, :3]) < 0.0:
            triangles = triangles[:, ::-1]
        self._parts.append((vertices, triangles))
        self._vertex_count += len(vertices)

    def is_empty(self) -> bool:
        """Whether no part has been put anywhere."""
        return not self._parts

    def mesh(self, metres: float) -> RawMesh:
        """All parts [m]. Raises FormatError if there are none.

        Args:
            metres: per unit of the parts.
        """
        if not any(len(triangles) for _, triangles in self._parts):
            raise FormatError("there are no triangles in it")
        vertices, triangles = zip(*self._parts)
        return RawMesh(metres * np.concatenate(vertices), np.concatenate(triangles))


def check_depth(depth: int) -> None:
    """Raises FormatError if parts are within parts without an end."""
    if depth > LARGEST_DEPTH:
        raise FormatError("parts of it are within one another in a circle, or too deep")


def check_range(corners: np.ndarray, vertices: int, thing: str) -> None:
    """Raises FormatError if a corner is of no vertex."""
    wrong = (corners < 0) | (corners >= vertices)
    if wrong.any():
        text = "{} name vertex {}; the {} vertices are counted from 0"
        raise FormatError(text.format(thing, int(corners[np.argmax(wrong)]), vertices))
