"""The plane of a planar obstacle: from the fixed frame to coordinates in the plane and back."""

import numpy as np

from deformable_manipulation.scenario.rotation import rotate

PLANE_AXES = {"xy": (0, 1), "yz": (1, 2), "xz": (0, 2)}


class PlaneFrame:
    """Coordinates (u, v) [m] in the plane of a planar obstacle, counted from ``centre``.

    Points are given as homogeneous coordinates (u, v, 1), so that any number of signed distances
    to lines is one matrix product. In memory all u come first, then all v.

    Args:
        plane: one of PLANE_AXES.
        translation: (3,) of the obstacle [m].
        rotation: (4,) of the obstacle, quaternion x, y, z, w, not zero.
        centre: (2,) origin of (u, v) in the obstacle's own coordinates [m]. Near the polygon it
            keeps the rounding small.
    """

    def __init__(self, plane, translation, rotation, centre):
        unit = np.asarray(rotation, dtype=float) / np.linalg.norm(rotation)
        axes = np.eye(3)[list(PLANE_AXES[plane])]
        self._axes = np.array([rotate(tuple(unit), tuple(axis)) for axis in axes])
        self._projection = np.vstack((self._axes, np.zeros(3)))
        self._offset = np.append(-self._axes @ np.asarray(translation) - centre, 1.0)[:, None]

    def project(self, points):
        """Points (..., 3) of the fixed frame as (u, v, 1), an array (..., 3)."""
        flat = self._projection @ points.reshape(-1, 3).T
        flat += self._offset
        return flat.T.reshape(points.shape)

    def lift(self, vectors):
        """Vectors (..., 2) in the plane as vectors (..., 3) in the fixed frame."""
        return vectors @ self._axes
