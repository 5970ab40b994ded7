"""The plane of a planar obstacle."""

import numpy as np

from deformable_manipulation.geometry.rotation import rotate

PLANE_AXES = {"xy": (0, 1), "yz": (1, 2), "xz": (0, 2)}


class PlaneFrame:
    """Directions (u, v) in the plane of a planar obstacle.

    Args:
        plane: one of PLANE_AXES.
        rotation: (4,) of the obstacle, quaternion x, y, z, w, not zero.
    """

    def __init__(self, plane, rotation):
        unit = np.asarray(rotation, dtype=float) / np.linalg.norm(rotation)
        axes = np.eye(3)[list(PLANE_AXES[plane])]
        self._axes = np.array([rotate(tuple(unit), tuple(axis)) for axis in axes])

    def flatten(self, vectors):
        """Vectors (..., 3) of the fixed frame, seen along the normal, as vectors (..., 2)."""
        return vectors @ self._axes.T

    def lift(self, vectors):
        """Vectors (..., 2) in the plane as vectors (..., 3) in the fixed frame."""
        return vectors @ self._axes
