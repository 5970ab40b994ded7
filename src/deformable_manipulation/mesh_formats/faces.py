"""Faces of any number of corners, as files hold them, made into triangles."""

from typing import List, NamedTuple

import numpy as np

from deformable_manipulation.mesh_formats.ear_clipping import are_convex, ear_clipped


class FormatError(ValueError):
    """A file holds no mesh; the message says why and where, on one line."""


class RawMesh(NamedTuple):
    """What a file holds, before it is checked."""

    vertices: np.ndarray  # (V, 3), units of the file
    triangles: np.ndarray  # (T, 3) indices of vertices


def triangulated(vertices: np.ndarray, counts: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Triangles (T, 3) that fill faces, in the order of the faces.

    Convex faces are fans from their first corner; others are cut corner by corner, so that they
    stay within their outline. Faces of fewer than three corners have no triangles.

    Args:
        vertices: (V, 3).
        counts: (F,) corners of each face.
        corners: (sum of counts,) indices of vertices, which must exist.
    """
    starts = np.cumsum(counts) - counts
    pieces = np.maximum(counts - 2, 0)
    places = np.cumsum(pieces) - pieces
    triangles = np.empty((int(pieces.sum()), 3), dtype=np.int64)
    for count in np.unique(counts[counts >= 3]):
        chosen = np.flatnonzero(counts == count)
        faces = corners[starts[chosen][:, None] + np.arange(count)]
        made = faces[:, _fan(count)]
        if count > 3:
            for index in np.flatnonzero(~are_convex(vertices[faces])):
                made[index] = faces[index][ear_clipped(vertices[faces[index]])]
        triangles[places[chosen][:, None] + np.arange(count - 2)] = made
    return without_collapsed(triangles)


def without_collapsed(triangles: np.ndarray) -> np.ndarray:
    """The triangles (T, 3) with three different corners."""
    first, second, third = triangles.T
    return triangles[(first != second) & (second != third) & (third != first)]


def strips(runs: List[np.ndarray]) -> np.ndarray:
    """Triangles (T, 3) of strips: every corner after the second makes one with the two before."""
    made = [np.empty((0, 3), dtype=np.int64)]
    for run in runs:
        triangles = np.stack((run[:-2], run[1:-1], run[2:]), axis=1)
        triangles[1::2] = triangles[1::2, [1, 0, 2]]  # every other one is wound the other way
        made.append(triangles)
    return without_collapsed(np.concatenate(made))


def fans(runs: List[np.ndarray]) -> np.ndarray:
    """Triangles (T, 3) of fans around the first corner of each run."""
    made = [np.empty((0, 3), dtype=np.int64)]
    made += [run[_fan(len(run))] for run in runs if len(run) >= 3]
    return without_collapsed(np.concatenate(made))


def _fan(count: int) -> np.ndarray:
    second = np.arange(1, count - 1)
    return np.stack((np.zeros_like(second), second, second + 1), axis=1)
