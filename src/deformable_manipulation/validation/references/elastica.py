"""Planar Kirchhoff rod (elastica) under its own weight: a boundary value problem.

In the vertical plane x-z, with the angle a of the tangent above x, the internal force n and moment
m that the part ahead exerts on the part behind, weight w per length and bending stiffness EI:

    x' = cos a,  z' = sin a,  EI a' = m,  m' = n_x sin a - n_z cos a,  n_x' = 0,  n_z' = w.

See S. S. Antman: Nonlinear Problems of Elasticity, chapter 4. Solved in units of the length and of
EI / length^2, by collocation (scipy.integrate.solve_bvp).
"""

from dataclasses import dataclass
from typing import List, Sequence, Tuple, Union

import numpy as np
from scipy.integrate import solve_bvp

from deformable_manipulation.validation.references.catenary import solve_catenary

TOLERANCE = 1e-9
MAX_NODES = 200000
NODES = 401  # of the first guess
LOAD_STEP = 3.0  # largest factor between two loads of the continuation


@dataclass(frozen=True)
class Clamped:
    """An end held at an angle [rad] of its tangent."""

    angle: float = 0.0


@dataclass(frozen=True)
class Pinned:
    """An end that turns freely, and carries a stub of the rod beyond it (length in m)."""

    overhang: float = 0.0


End = Union[Clamped, Pinned]
Point = Tuple[float, float]


class Elastica:
    """The rod between two points that are held, in SI units; arc lengths begin at the first."""

    def __init__(self, length: float, stiffness: float, solution):
        self.length = length
        self._solution = solution  # state (6, n) at arc lengths (n,) in units of the length
        force = stiffness / length**2
        self._units = np.array([length, length, 1.0, force * length, force, force])

    def _state(self, arc_lengths) -> np.ndarray:
        scaled = np.asarray(arc_lengths, dtype=float) / self.length
        return (self._solution(scaled).T * self._units).T

    def positions(self, arc_lengths) -> np.ndarray:
        """Points (n, 2), x and z [m]."""
        return self._state(arc_lengths)[:2].T

    def angles(self, arc_lengths) -> np.ndarray:
        """Angles (n,) [rad] of the tangent above x."""
        return self._state(arc_lengths)[2]

    def moments(self, arc_lengths) -> np.ndarray:
        """Moments (n,) [N m] of the part ahead on the part behind, from x towards z."""
        return self._state(arc_lengths)[3]

    def forces(self, arc_lengths) -> np.ndarray:
        """Forces (n, 2) [N] of the part ahead on the part behind."""
        return self._state(arc_lengths)[4:].T


def solve_cantilever(
    length: float, stiffness: float, weight: float, angle: float = 0.0
) -> Elastica:
    """Find the shape of a rod clamped at one end and free at the other.

    length [m], stiffness EI [N m^2], weight per length [N/m]. Loaded step by step, so that it is
    the shape reached from the straight one.
    """

    def conditions(first, last):
        start = [first[0], first[1], first[2] - angle]
        return np.array(start + [last[3], last[4], last[5]])

    nodes = np.linspace(0.0, 1.0, NODES)
    guess = np.zeros((6, NODES))
    guess[0] = np.cos(angle) * nodes
    guess[1] = np.sin(angle) * nodes
    guess[2] = angle
    for load in _loads_up_to(weight * length**3 / stiffness):
        bvp = _solve([load], conditions, nodes, guess)
        nodes, guess = bvp.x, bvp.y
    return Elastica(length, stiffness, bvp.sol)


def solve_between(
    length: float, stiffness: float, weight: float, chord: Point, start: End, end: End
) -> Elastica:
    """Find the shape of a slack rod that hangs from the origin to a point ``chord`` (x, z) [m]."""
    return solve_spans([length], stiffness, weight, [(0.0, 0.0), chord], start, end)[0]


def solve_spans(
    lengths: Sequence[float],
    stiffness: float,
    weight: float,
    points: Sequence[Point],
    start: End,
    end: End,
) -> List[Elastica]:
    """Find the shape of a rod that hangs from pins at points (x, z) [m], slack between them.

    lengths [m] of the spans between the points; ``start`` and ``end`` tell how the first and the
    last point hold. At the pins between, angle and moment are continuous. The first guess is the
    catenary, so that it is the shape next to that.
    """
    spans = np.asarray(lengths, dtype=float)
    pins = np.asarray(points, dtype=float)
    loads = weight * spans**3 / stiffness

    def conditions(first, last):
        first, last = first.reshape(-1, 6), last.reshape(-1, 6)
        held = [
            ((first[:, :2].T * spans).T - pins[:-1]).ravel(),
            ((last[:, :2].T * spans).T - pins[1:]).ravel(),
            [_end_condition(start, first[0], loads[0], spans[0])],
            [_end_condition(end, last[-1], loads[-1], spans[-1])],
            last[:-1, 2] - first[1:, 2],
            last[:-1, 3] / spans[:-1] - first[1:, 3] / spans[1:],
        ]
        return np.concatenate(held)

    nodes = np.linspace(0.0, 1.0, NODES)
    guess = np.vstack(
        [
            _catenary_guess(here / length, there / length, load, nodes)
            for here, there, length, load in zip(pins[:-1], pins[1:], spans, loads)
        ]
    )
    bvp = _solve(loads, conditions, nodes, guess)
    return [
        Elastica(length, stiffness, lambda s, k=k: bvp.sol(s)[6 * k : 6 * k + 6])
        for k, length in enumerate(spans)
    ]


def _end_condition(end: End, state: np.ndarray, load: float, length: float) -> float:
    if isinstance(end, Clamped):
        return state[2] - end.angle
    # The weight of the stub beyond the pin turns about it (half its length is the arm).
    return state[3] + 0.5 * load * (end.overhang / length) ** 2 * np.cos(state[2])


def _catenary_guess(
    start: np.ndarray, end: np.ndarray, load: float, nodes: np.ndarray
) -> np.ndarray:
    chain = solve_catenary(1.0, *(end - start))
    angles = chain.angles(nodes)
    tension = load * chain.scale
    return np.vstack(
        [
            start[:, None] + chain.positions(nodes).T,
            angles,
            np.gradient(angles, nodes),
            np.full_like(nodes, tension),
            tension * np.tan(angles),
        ]
    )


def _loads_up_to(load: float) -> np.ndarray:
    steps = 1 + max(0, int(np.ceil(np.log(max(load, 1.0)) / np.log(LOAD_STEP))))
    return load * np.power(LOAD_STEP, np.arange(1 - steps, 1, dtype=float))


def _solve(loads: Sequence[float], conditions, nodes: np.ndarray, guess: np.ndarray):
    """Solve spans side by side: the state (6 spans, n) is that of one after that of another."""

    def derivatives(_, y):
        return np.vstack([_derivatives(load, y[6 * k : 6 * k + 6]) for k, load in enumerate(loads)])

    bvp = solve_bvp(derivatives, conditions, nodes, guess, tol=TOLERANCE, max_nodes=MAX_NODES)
    if not bvp.success:
        raise RuntimeError(f"the elastica of load {loads} was not found: {bvp.message}")
    return bvp


def _derivatives(load: float, y: np.ndarray) -> np.ndarray:
    cosine, sine = np.cos(y[2]), np.sin(y[2])
    bending = y[4] * sine - y[5] * cosine
    return np.array([cosine, sine, y[3], bending, np.zeros_like(sine), np.full_like(sine, load)])


def small_deflection(length: float, stiffness: float, weight: float) -> float:
    """Drop [m] of the tip of a cantilever by linear beam theory."""
    return weight * length**4 / (8.0 * stiffness)
