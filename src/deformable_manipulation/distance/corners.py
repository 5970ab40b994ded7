"""The places of obstacles."""

import numpy as np

from deformable_manipulation.geometry.mesh_files import scaled_mesh
from deformable_manipulation.geometry.planes import PlaneFrame
from deformable_manipulation.geometry.rotation import rotate
from deformable_manipulation.scenario.spec import MeshObstacle


def obstacle_corners(obstacle) -> np.ndarray:
    """Corners (N, 3) [m] of an obstacle in the fixed frame; a polygon is endless beyond them.

    Raises:
        ValueError: the mesh's file cannot be read.
    """
    if isinstance(obstacle, MeshObstacle):
        turn = np.array([rotate(obstacle.rotation, tuple(axis)) for axis in np.eye(3)])
        return scaled_mesh(obstacle)[0] @ turn + np.array(obstacle.translation)
    frame = PlaneFrame(obstacle.plane, obstacle.rotation)
    corners = np.concatenate([np.array(ring) for ring in obstacle.rings])
    return frame.lift(corners) + np.array(obstacle.translation)
