"""The exact equilibrium of a fabric's mesh: its energy minimised by Newton's method.

The energy is that of docs/mathematics.md, written down anew: springs along the edges, folds of
pairs of triangles from the gradients of linear functions, and weight.
"""

from typing import Dict, List, Sequence, Tuple

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import splu

GRAVITY = 9.81  # m/s^2
ITERATIONS = 500
LONGEST_STEP = 0.1  # m
CONVEX_SHIFT = 1e-3  # N/m


class MeshEnergy:
    """Energy of a fabric, and its derivatives, by the positions (P, 3) [m] of its vertices."""

    def __init__(
        self,
        vertices: np.ndarray,
        triangles: np.ndarray,
        density: float,
        stretching_compliance: float,
        bending_compliance: float,
    ):
        corners = np.asarray(vertices, dtype=float)[triangles]
        sides = corners[:, 1:] - corners[:, :1]
        areas = 0.5 * np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
        self.masses = np.zeros(len(vertices))
        np.add.at(self.masses, np.ravel(triangles), np.repeat(density * areas / 3.0, 3))
        owners = _owners(triangles)
        self.edges = np.array(list(owners))
        ends = np.asarray(vertices, dtype=float)[self.edges]
        self.lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        edge_areas = np.array([areas[list(of_edge)].sum() for of_edge in owners.values()])
        self.springs = edge_areas / (stretching_compliance * self.lengths**2)  # N/m
        jumps = _jumps(vertices, triangles, owners, self.lengths)
        weights = [
            0.0 if len(of_edge) < 2 else length**2 / (area * bending_compliance)
            for of_edge, length, area in zip(owners.values(), self.lengths, edge_areas)
        ]
        self.bending = sparse.csr_matrix(jumps.T @ sparse.diags(weights) @ jumps)  # N/m
        self._bending_of_all = sparse.kron(self.bending, sparse.eye(3)).tocsc()

    def energy(self, positions: np.ndarray) -> float:
        """Energy [J] with that of the weight."""
        extension = np.linalg.norm(self._spans(positions), axis=1) - self.lengths
        stretching = 0.5 * self.springs @ extension**2
        bending = 0.5 * np.sum(positions * (self.bending @ positions))
        return stretching + bending + GRAVITY * self.masses @ positions[:, 2]

    def gradient(self, positions: np.ndarray) -> np.ndarray:
        """Minus the forces (P, 3) [N]."""
        spans = self._spans(positions)
        slack = 1.0 - self.lengths / np.linalg.norm(spans, axis=1)
        pulls = (self.springs * slack)[:, None] * spans
        gradient = self.bending @ positions
        np.add.at(gradient, self.edges[:, 1], pulls)
        np.add.at(gradient, self.edges[:, 0], -pulls)
        gradient[:, 2] += GRAVITY * self.masses
        return gradient

    def hessian(self, positions: np.ndarray, convex: bool) -> sparse.csc_matrix:
        """Second derivatives (3P, 3P) [N/m]; convex: without what compressed springs take away."""
        spans = self._spans(positions)
        lengths = np.linalg.norm(spans, axis=1)
        across = 1.0 - self.lengths / lengths
        if convex:
            across = np.maximum(across, 0.0)
        along = spans / lengths[:, None]
        blocks = (1.0 - across)[:, None, None] * along[:, :, None] * along[:, None, :]
        blocks = self.springs[:, None, None] * (blocks + across[:, None, None] * np.eye(3))
        places = 3 * self.edges[:, :, None] + np.arange(3)
        rows, columns, values = [], [], []
        for p in (0, 1):
            for q in (0, 1):
                rows.append(np.repeat(places[:, p], 3, axis=1).ravel())
                columns.append(np.tile(places[:, q], (1, 3)).ravel())
                values.append((blocks if p == q else -blocks).ravel())
        entries = (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns)))
        return sparse.csc_matrix(entries, self._bending_of_all.shape) + self._bending_of_all

    def minimised(
        self, positions: np.ndarray, held: Sequence[int], tolerance: float = 1e-8
    ) -> np.ndarray:
        """Positions (P, 3) [m] of least energy near those given, with some vertices held.

        tolerance: of the forces [N]. Raises RuntimeError if it is not reached.
        """
        free = np.flatnonzero(~np.isin(np.repeat(np.arange(len(positions)), 3), list(held)))
        positions = np.array(positions, dtype=float)
        for _ in range(ITERATIONS):
            gradient = self.gradient(positions).ravel()[free]
            if np.abs(gradient).max() < tolerance:
                return positions
            positions = self._descended(positions, free, gradient)
        raise RuntimeError("the equilibrium of the mesh was not found")

    def response(self, positions: np.ndarray, held: Sequence[int]) -> np.ndarray:
        """How an equilibrium follows its held vertices: (H, P, 3, 3) d position / d held position.

        By implicit differentiation: where the forces on the free vertices stay zero, the Hessian's
        rows of these give K dx + K_h dx_h = 0. Means nothing where K is singular.
        """
        of_vertex = np.arange(3 * len(positions)).reshape(-1, 3)
        free = np.delete(of_vertex, list(held), axis=0).ravel()
        fixed = of_vertex[list(held)].ravel()
        rows = self.hessian(positions, convex=False)[free]
        moved = np.zeros((3 * len(positions), len(fixed)))
        moved[free] = -splu(rows[:, free].tocsc()).solve(rows[:, fixed].toarray())
        moved[fixed] = np.eye(len(fixed))
        return moved.reshape(len(positions), 3, -1, 3).transpose(2, 0, 1, 3)

    def _spans(self, positions: np.ndarray) -> np.ndarray:
        return positions[self.edges[:, 1]] - positions[self.edges[:, 0]]

    def _descended(self, positions, free, gradient):
        """Take a step of Newton's method, with the convex part alone where that leads upwards."""
        energy = self.energy(positions)
        for convex in (False, True):
            hessian = self.hessian(positions, convex)[free][:, free]
            shift = CONVEX_SHIFT if convex else 0.0
            step = -splu((hessian + shift * sparse.eye(len(free))).tocsc()).solve(gradient)
            slope = step @ gradient
            if slope >= 0.0:
                continue
            factor = min(1.0, LONGEST_STEP / np.abs(step).max())
            while factor > 1e-9:
                trial = positions.copy()
                trial.reshape(-1)[free] += factor * step
                # Near the minimum, differences of the energy drown in rounding.
                closer = np.abs(self.gradient(trial).ravel()[free]).max() < np.abs(gradient).max()
                flat = abs(factor * slope) < 1e-12 * max(1.0, abs(energy))
                if self.energy(trial) < energy + 1e-4 * factor * slope or (flat and closer):
                    return trial
                factor *= 0.5
        raise RuntimeError("the energy of the mesh does not fall any more")


def _owners(triangles: np.ndarray) -> Dict[Tuple[int, int], List[int]]:
    """Triangles of every edge, by its vertices in order."""
    owners: Dict[Tuple[int, int], List[int]] = {}
    for triangle, vertices in enumerate(np.asarray(triangles)):
        for k in range(3):
            edge = tuple(sorted((int(vertices[k]), int(vertices[(k + 1) % 3]))))
            owners.setdefault(edge, []).append(triangle)
    return owners


def _jumps(vertices, triangles, owners, lengths) -> sparse.csr_matrix:
    """Jump (E, P) [1/m] of the slope of a function of the vertices across each edge.

    It sums, over the triangles of the edge, the slope towards the opposite corner.
    """
    entries: Dict[Tuple[int, int], float] = {}
    for row, (edge, of_edge) in enumerate(owners.items()):
        start = np.asarray(vertices[edge[0]], dtype=float)
        along = (np.asarray(vertices[edge[1]]) - start) / lengths[row]
        for triangle in of_edge:
            (corner,) = set(triangles[triangle].tolist()) - set(edge)
            arm = np.asarray(vertices[corner]) - start
            foot = arm @ along
            height = float(np.linalg.norm(arm - foot * along))
            part = foot / lengths[row]
            for vertex, value in ((corner, 1.0), (edge[0], part - 1.0), (edge[1], -part)):
                entries[row, vertex] = entries.get((row, vertex), 0.0) + value / height
    rows, columns = zip(*entries)
    shape = (len(owners), len(vertices))
    return sparse.csr_matrix((list(entries.values()), (rows, columns)), shape)
