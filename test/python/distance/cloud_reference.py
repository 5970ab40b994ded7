"""Distances to points by formulas in numpy, each point with each element."""

import numpy as np


def segment_distances(points, starts, ends):
    """Distances (E, N) of segments (E, 3) to points (N, 3)."""
    way = ends - starts
    squared = np.maximum(np.sum(way**2, axis=1), 1e-300)
    arms = points - starts[:, None]
    along = np.clip(np.einsum("eni,ei->en", arms, way) / squared[:, None], 0.0, 1.0)
    return np.linalg.norm(arms - along[..., None] * way[:, None], axis=2)


def triangle_distances(points, corners):
    """Distances (E, N) of triangles (E, 3, 3) to points (N, 3): to their sides, or their faces."""
    distances = np.min(
        [segment_distances(points, corners[:, k], corners[:, (k + 1) % 3]) for k in range(3)],
        axis=0,
    )
    first, second, third = np.moveaxis(corners, 1, 0)
    normal = np.cross(second - first, third - first)
    length = np.linalg.norm(normal, axis=1)
    for e in np.flatnonzero(length):
        frame = np.stack((second[e] - first[e], third[e] - first[e], normal[e] / length[e]), axis=1)
        u, v, height = np.linalg.solve(frame, (points - first[e]).T)
        over = (u >= 0.0) & (v >= 0.0) & (u + v <= 1.0)
        distances[e, over] = np.minimum(distances[e, over], np.abs(height[over]))
    return distances


def element_distances(points, geometry, triangles=None):
    """Distances (E, N) of an object's segments or triangles to points (N, 3)."""
    if triangles is None:
        return segment_distances(points, geometry[:-1], geometry[1:])
    return triangle_distances(points, geometry[triangles])
