"""A straight rod, clamped at both ends, one of them turned about its axis."""

import numpy as np
from scipy.optimize import brentq


def reaction_torque(torsion_stiffness: float, length: float, turn: float) -> float:
    """Torque [N m] of the straight rod: G J turn / length (N m^2, m, rad)."""
    return torsion_stiffness * turn / length


def critical_moment_factor() -> float:
    """Find M L / (E I) at which a clamped rod without thrust leaves the straight shape: 8.9868.

    The first root of tan(x) = x, x = M L / (2 E I) (S. P. Timoshenko, J. M. Gere: Theory of Elastic
    Stability, section 2.21, buckling of a twisted shaft, for clamped ends).
    """
    return 2.0 * brentq(lambda x: np.sin(x) - x * np.cos(x), np.pi, 1.5 * np.pi)


def critical_turn(bending_stiffness: float, torsion_stiffness: float) -> float:
    """Turn [rad] of one end at which that happens, where the end is free to slide."""
    return critical_moment_factor() * bending_stiffness / torsion_stiffness
