"""Depth images of triangles."""

from typing import Iterator, Tuple

import numpy as np

_NEAR = 1e-3  # m, of corners in front of the camera
_MOST_PAIRS = 500_000  # of triangles and pixels that are looked at together


class Raster:
    """Pixels of a pinhole camera: x to the right, y down, z forward.

    Args:
        width, height: pixels.
        field_of_view: [rad] from the left to the right edge.
    """

    def __init__(self, width: int, height: int, field_of_view: float):
        self.width, self.height = width, height
        self._focal = 0.5 * width / np.tan(0.5 * field_of_view)  # pixels
        u = (np.arange(width) + 0.5 - 0.5 * width) / self._focal
        v = (np.arange(height) + 0.5 - 0.5 * height) / self._focal
        #: (H * W, 3) of each pixel, row by row; z is 1.
        self.directions = np.stack(
            np.broadcast_arrays(u[None, :], v[:, None], 1.0), axis=-1
        ).reshape(-1, 3)

    def depths(self, triangles: np.ndarray) -> np.ndarray:
        """Depth [m] along z of the nearest triangle in each pixel (H * W,); infinite: none.

        Args:
            triangles: (T, 3, 3) m, corners in the camera's frame.
        """
        depths = np.full(self.width * self.height, np.inf)
        triangles = triangles[(triangles[:, :, 2] > _NEAR).any(axis=1)]
        a, b, c = (triangles[:, k] for k in range(3))
        # The ray along d is inside where these have one sign, for the triangle is met where
        # d = u a + v b + w c with u, v, w of one sign.
        edges = np.stack((np.cross(b, c), np.cross(c, a), np.cross(a, b)), axis=1)
        volumes = (a * edges[:, 0]).sum(axis=1)
        for which, pixels in self._pairs(triangles):
            shares = (edges[which] @ self.directions[pixels][:, :, None])[:, :, 0]
            total = shares.sum(axis=1)
            hit = ((shares >= 0.0).all(axis=1) | (shares <= 0.0).all(axis=1)) & (total != 0.0)
            found = volumes[which[hit]] / total[hit]
            ahead = found > 0.0
            np.minimum.at(depths, pixels[hit][ahead], found[ahead])
        return depths

    def _pairs(self, triangles: np.ndarray) -> Iterator[Tuple[np.ndarray, np.ndarray]]:
        """Triangles and the pixels that they may cover, in pieces of limited size."""
        low, high = self._boxes(triangles)
        size = np.maximum(high - low, 0)
        counts = size[:, 0] * size[:, 1]
        order = np.flatnonzero(counts)
        ends = np.cumsum(counts[order])
        for first in range(0, int(ends[-1]) if len(ends) else 0, _MOST_PAIRS):
            flat = np.arange(first, min(first + _MOST_PAIRS, ends[-1]))
            place = np.searchsorted(ends, flat, side="right")
            which = order[place]
            within = flat - (ends[place] - counts[which])
            column = low[which, 0] + within % size[which, 0]
            row = low[which, 1] + within // size[which, 0]
            yield which, row * self.width + column

    def _boxes(self, triangles: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
        """First pixels (T, 2) as column and row, and those after the last; all, if behind, too."""
        last = np.array((self.width, self.height))
        in_front = (triangles[:, :, 2] > _NEAR).all(axis=1)
        depth = np.where(in_front[:, None], triangles[:, :, 2], 1.0)
        pixels = self._focal * triangles[:, :, :2] / depth[:, :, None] + 0.5 * last
        low = np.floor(np.clip(pixels.min(axis=1), 0.0, last)).astype(int)
        high = np.ceil(np.clip(pixels.max(axis=1), 0.0, last)).astype(int)
        low[~in_front], high[~in_front] = 0, last
        return low, high
