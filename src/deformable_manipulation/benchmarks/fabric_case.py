"""The cloth that all libraries simulate; plain numbers, for they go to other interpreters."""

from abc import abstractmethod
from collections import defaultdict
from dataclasses import dataclass
from typing import List, Tuple

import numpy as np

from deformable_manipulation.benchmarks.trial import Case, Model, UndampedModel


class FabricModel(Model):
    """A cloth whose points (n, 3) [m] are the vertices of its mesh."""

    @abstractmethod
    def place_held(self, positions: np.ndarray, velocities: np.ndarray) -> None:
        """Put held vertices at positions (h, 3) [m] where the next step ends; velocities [m/s]."""


class UndampedFabricModel(UndampedModel, FabricModel):
    """A cloth in a library that has no damping."""


@dataclass(frozen=True)
class FabricCase(Case):
    """A cloth at rest in the plane z = 0, drawn in by held vertices; gravity is against z.

    Its edges are springs, and pairs of its triangles resist folding, as docs/mathematics.md says.
    """

    vertices: List[List[float]]  # m
    triangles: List[List[int]]
    masses: List[float]  # kg, of the vertices
    edges: List[List[int]]
    springs: List[float]  # N/m, of the edges
    density: float  # kg/m^2
    stretching_compliance: float  # m/N
    bending_compliance: float  # 1/(N m)
    held: List[int]  # vertices
    part: float  # of their distance from the origin to which the held vertices are drawn in
    gravity: float = 9.81  # m/s^2
    damping: float = 10.0  # 1/s

    drawn_in = True

    def draw_in(self, model: FabricModel, progress: float, rate: float) -> None:
        places = np.array(self.vertices)[self.held]
        way = (self.part - 1.0) * places
        model.place_held(places + progress * way, rate * way)

    def hinges(self) -> List[Tuple[int, int, int, int]]:
        """Vertices of each pair of triangles: those opposite of their edge, then its own."""
        opposite = defaultdict(list)
        for triangle in self.triangles:
            for k in range(3):
                first, second = sorted((triangle[k], triangle[(k + 1) % 3]))
                opposite[first, second].append(triangle[(k + 2) % 3])
        return [
            (corners[0], corners[1], *edge)
            for edge, corners in opposite.items()
            if len(corners) == 2
        ]
