"""Meshes whose triangles do not quite meet: corners apart by rounding, corners on others' edges."""

from typing import Iterator, NamedTuple, Optional, Tuple

import numpy as np

WELDING_TOLERANCE = 1e-6  # of the diagonal of the mesh's box
_SINGLE_STEPS = 2  # of single precision at the largest coordinate, if all coordinates have that
_MOST_PASSES = 50  # a triangle is split once in each


class MendedMesh(NamedTuple):
    """A mesh, and what was done for it to meet."""

    vertices: np.ndarray  # (V, 3)
    triangles: np.ndarray  # (T, 3)
    splits: int  # vertices of other triangles that were on an edge
    place: Optional[np.ndarray]  # (3,) of the first such vertex

    def warnings(self) -> Iterator[str]:
        """What was done, in sentences."""
        if self.place is not None:
            yield (
                "{} where a vertex lies on the edge of a triangle that does not have it, the first "
                "at ({:g}, {:g}, {:g}): these triangles are split there, or the surface would tear"
            ).format(
                "1 place" if self.splits == 1 else "{} places".format(self.splits), *self.place
            )


def tolerance_of(vertices: np.ndarray) -> float:
    """How far apart two corners may be that are one, in the unit of the vertices (V, 3)."""
    diagonal = np.linalg.norm(np.ptp(vertices, axis=0))
    with np.errstate(over="ignore"):
        single = vertices.astype(np.float32)
    step = np.spacing(np.abs(single).max()) if (single == vertices).all() else 0.0
    return max(WELDING_TOLERANCE * float(diagonal), _SINGLE_STEPS * float(step))


def mended(vertices: np.ndarray, triangles: np.ndarray) -> MendedMesh:
    """Weld the corners along open edges, and split triangles where others' corners lie on those.

    An edge is open if it belongs to one triangle only: where all edges are shared, nothing changes.

    Args:
        vertices: (V, 3), at different places, all of them used.
        triangles: (T, 3).
    """
    return split_at_corners(*_welded(vertices, triangles, tolerance_of(vertices)))


def split_at_corners(vertices: np.ndarray, triangles: np.ndarray) -> MendedMesh:
    """Split triangles where vertices of others lie on their edges; the vertices stay as they are.

    Args:
        vertices: (V, 3).
        triangles: (T, 3).
    """
    tolerance = tolerance_of(vertices)
    count, first = 0, None
    for _ in range(_MOST_PASSES):
        found = _corners_on_edges(vertices, triangles, tolerance)
        if not len(found[0]):
            break
        first = vertices[found[2][0]] if first is None else first
        count += len(found[0])
        triangles = _split(triangles, *found)
    return MendedMesh(vertices, triangles, count, first)


def without_unused(vertices: np.ndarray, triangles: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
    """The vertices that triangles have, in their order, and the triangles."""
    used = np.zeros(len(vertices), dtype=bool)
    used[triangles] = True
    return vertices[used], (np.cumsum(used) - 1)[triangles]


def _open_edges(triangles: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
    """Triangles (E,) and which of their edges (E,) belong to no other triangle."""
    ends = np.stack((triangles, np.roll(triangles, -1, axis=1)), axis=2).reshape(-1, 2)
    keys = ends.min(axis=1) * (int(triangles.max()) + 1) + ends.max(axis=1)
    _, first, counts = np.unique(keys, return_index=True, return_counts=True)
    alone = np.sort(first[counts == 1])
    return alone // 3, alone % 3


def _welded(
    vertices: np.ndarray, triangles: np.ndarray, tolerance: float
) -> Tuple[np.ndarray, np.ndarray]:
    owners, sides = _open_edges(triangles)
    rim = np.unique([triangles[owners, sides], triangles[owners, (sides + 1) % 3]])
    pairs = _near_pairs(vertices[rim], tolerance)
    if not len(pairs):
        return vertices, triangles
    same_as = np.arange(len(vertices))
    same_as[rim] = rim[_first_of_each_group(pairs, len(rim))]
    merged = same_as[triangles]
    kept = (merged != np.roll(merged, 1, axis=1)).all(axis=1)
    if not kept.any():
        return vertices, triangles
    return without_unused(vertices, merged[kept])


def _near_pairs(points: np.ndarray, distance: float) -> np.ndarray:
    if not len(points):
        return np.empty((0, 2), dtype=np.int64)
    from scipy.spatial import cKDTree  # takes long to import, and closed meshes do not need it

    return cKDTree(points).query_pairs(distance, output_type="ndarray")


def _first_of_each_group(pairs: np.ndarray, count: int) -> np.ndarray:
    """For each of ``count`` points, the first of those that chains of pairs join to it."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    graph = coo_matrix((np.ones(len(pairs)), pairs.T), shape=(count, count))
    _, groups = connected_components(graph, directed=False)
    _, first = np.unique(groups, return_index=True)
    return first[groups]


def _corners_on_edges(
    vertices: np.ndarray, triangles: np.ndarray, tolerance: float
) -> Tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Triangles, their edges and the vertices of others within those, one for each triangle."""
    owners, sides = _open_edges(triangles)
    starts, ends = triangles[owners, sides], triangles[owners, (sides + 1) % 3]
    rim = np.unique([starts, ends])
    edges, corners = _near_edges(vertices, starts, ends, rim, tolerance)
    step = vertices[ends[edges]] - vertices[starts[edges]]
    arm = vertices[corners] - vertices[starts[edges]]
    length = np.maximum(np.linalg.norm(step, axis=1), tolerance)
    along = np.einsum("ij,ij->i", arm, step) / length
    aside = np.linalg.norm(arm - (along / length)[:, None] * step, axis=1)
    within = (aside <= tolerance) & (along > tolerance) & (along < length - tolerance)
    within &= corners != triangles[owners[edges], (sides[edges] + 2) % 3]
    _, first = np.unique(owners[edges[within]], return_index=True)
    chosen = np.flatnonzero(within)[first]
    return owners[edges[chosen]], sides[edges[chosen]], corners[chosen]


def _near_edges(
    vertices: np.ndarray, starts: np.ndarray, ends: np.ndarray, rim: np.ndarray, tolerance: float
) -> Tuple[np.ndarray, np.ndarray]:
    """Edges (K,) and vertices (K,) of the rim in the balls around these."""
    if not len(rim):
        return np.empty(0, dtype=np.int64), np.empty(0, dtype=np.int64)
    from scipy.spatial import cKDTree

    middles = 0.5 * (vertices[starts] + vertices[ends])
    radii = 0.5 * np.linalg.norm(vertices[ends] - vertices[starts], axis=1)
    near = cKDTree(vertices[rim]).query_ball_point(middles, radii + tolerance)
    edges = np.repeat(np.arange(len(starts)), [len(each) for each in near])
    corners = rim[np.concatenate([np.asarray(each, dtype=np.int64) for each in near])]
    return edges, corners


def _split(
    triangles: np.ndarray, owners: np.ndarray, sides: np.ndarray, corners: np.ndarray
) -> np.ndarray:
    """The triangles, the owners cut in two from the corners on their sides."""
    starts, ends = triangles[owners, sides], triangles[owners, (sides + 1) % 3]
    opposite = triangles[owners, (sides + 2) % 3]
    kept = triangles.copy()
    kept[owners] = np.stack((starts, corners, opposite), axis=1)
    return np.concatenate((kept, np.stack((corners, ends, opposite), axis=1)))
