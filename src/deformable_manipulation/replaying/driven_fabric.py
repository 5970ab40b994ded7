"""A fabric that is driven as a recorded one was."""

from typing import List, Sequence, Tuple

import numpy as np
import trimesh
from scipy.interpolate import RBFInterpolator

from deformable_manipulation.objects.fabric import FabricSpec
from deformable_manipulation.replaying.grips import Grip
from deformable_manipulation.replaying.measured_shapes import MeasuredShapes, MeasuredShapesError

_OFF = 0.01  # of the fabric's size, by which a point may lie beside it
_AT_VERTEX = 1e-3  # m
_FLAT = 1e-9  # of the fabric's size
_UPRIGHT = (0.0, 0.0, 0.0, 1.0)


class DrivenFabric:
    """Where a fabric is held, and how measured points lie on it.

    A gripper pins the vertices at the points that it holds; each moves as its point did.

    Args:
        spec: the fabric.
        shapes: the recording.
        held: for each gripper the points that it holds.

    Raises:
        MeasuredShapesError: the recording does not fit the fabric.
    """

    def __init__(self, spec: FabricSpec, shapes: MeasuredShapes, held: Sequence[Tuple[int, ...]]):
        self._vertices = np.array(spec.vertices)
        self._size = float(np.ptp(self._vertices, axis=0).max())
        self._places = _in_space(shapes)
        self.held = held
        self._locate(np.array(spec.triangles))
        self._require_spread()
        self.grips = self._grips(shapes)

    def spread(self, values: np.ndarray) -> np.ndarray:
        """Values (M, 3) at the measured points, taken smoothly to the vertices (V, 3)."""
        axes = self._extended()
        # Three points have a plane, more a thin plate through all of them.
        kernel = "thin_plate_spline" if len(axes) == 2 else "cubic"
        between = RBFInterpolator(self._places[:, axes], values, kernel=kernel, degree=1)
        return between(self._vertices[:, axes])

    def measured(self, vertices: np.ndarray) -> np.ndarray:
        """The measured points (M, 3) on the fabric with these vertices (V, 3)."""
        return np.einsum("mk,mkx->mx", self._weights, vertices[self._corners])

    def _locate(self, triangles: np.ndarray) -> None:
        """The corners and weights of the triangle on which each point lies."""
        mesh = trimesh.Trimesh(self._vertices, triangles, process=False)
        nearest, distance, faces = trimesh.proximity.closest_point(mesh, self._places)
        beside = np.flatnonzero(distance > _OFF * self._size)
        if beside.size:
            raise MeasuredShapesError(
                "\n".join(
                    f"the point at {_text(self._places[number])} m is {distance[number]:.3g} m "
                    "beside the undeformed fabric: correct its columns or the object's size"
                    for number in beside
                )
            )
        self._corners = triangles[faces]
        corners = self._vertices[self._corners]
        self._weights = trimesh.triangles.points_to_barycentric(corners, nearest)

    def _extended(self) -> np.ndarray:
        """The axes along which the undeformed fabric extends."""
        return np.flatnonzero(np.ptp(self._vertices, axis=0) > _FLAT * self._size)

    def _require_spread(self) -> None:
        """Points on a line, or on a plane of a curved fabric, do not tell a shape."""
        axes = self._extended()
        centred = self._places[:, axes] - self._places[:, axes].mean(axis=0)
        if np.linalg.matrix_rank(centred, tol=1e-3 * self._size) < len(axes):
            shape = "a line" if len(axes) == 2 else "a plane"
            raise MeasuredShapesError(
                f"its points lie on {shape} of the undeformed fabric, which does not tell its "
                "first shape: measure points all over it"
            )

    def _grips(self, shapes: MeasuredShapes) -> List[Grip]:
        if not self.held:
            raise MeasuredShapesError(
                "say which points are held (--held): a fabric has no ends to be held at"
            )
        points = shapes.without_gaps()
        orientations = np.tile(_UPRIGHT, (len(points), 1))
        grips, mistakes = [], []
        for number in (number for numbers in self.held for number in numbers):
            away = np.linalg.norm(self._vertices - self._places[number], axis=1)
            vertex = int(away.argmin())
            if away[vertex] > _AT_VERTEX:
                mistakes.append(
                    f"point {number} is held, but lies {1000.0 * away[vertex]:.3g} mm from the "
                    f"nearest vertex, at {_text(self._vertices[vertex])} m: hold and measure a "
                    "vertex of the mesh, or use a mesh that has one there"
                )
            grips.append(Grip(vertex, "pinned", points[:, number], orientations))
        if mistakes:
            raise MeasuredShapesError("\n".join(mistakes))
        return grips


def _in_space(shapes: MeasuredShapes) -> np.ndarray:
    """The points' places (M, 3)."""
    if shapes.places.ndim == 1:
        raise MeasuredShapesError(
            "its points are those of a rod (x@S), but the object is a fabric: name them x@X/Y"
        )
    missing = 3 - shapes.places.shape[1]
    return np.pad(shapes.places, ((0, 0), (0, missing)))


def _text(place: np.ndarray) -> str:
    return "/".join(f"{number:.6g}" for number in place)
