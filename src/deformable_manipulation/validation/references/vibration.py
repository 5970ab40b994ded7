"""Small vibration of a straight rod held at one end: Rayleigh-Ritz with polynomials.

A rod of length L, mass per length rho, bending stiffness EI, under the tension T(s) = w (L - s) of
its own weight w per length (hanging down; 0 without gravity) has

    rho y'' + c rho y' + (EI y_ss)_ss - (T y_s)_s = 0,

and every mode decays at c / 2. Known limits: a beam clamped at one end, omega = 1.8751^2
sqrt(EI / (rho L^4)), and a hanging chain, omega = 2.4048 / 2 sqrt(g / L).
"""

from dataclasses import dataclass

import numpy as np
from numpy.polynomial import Polynomial
from numpy.polynomial.legendre import Legendre, leggauss
from scipy.linalg import eigh

POLYNOMIALS = 16


@dataclass(frozen=True)
class Mode:
    """Angular frequency [rad/s] without damping, and the shape over s / L."""

    frequency: float
    shape: Polynomial


def first_mode(
    length: float, stiffness: float, mass: float, weight: float = 0.0, clamped: bool = True
) -> Mode:
    """Find the slowest mode: length [m], EI [N m^2], mass [kg/m] and weight [N/m] per length."""
    held = Polynomial([0.0, 0.0, 1.0]) if clamped else Polynomial([0.0, 1.0])
    basis = [
        held * Legendre.basis(k, domain=[0.0, 1.0]).convert(kind=Polynomial)
        for k in range(POLYNOMIALS)
    ]
    nodes, weights = leggauss(2 * POLYNOMIALS)
    nodes, weights = 0.5 * (nodes + 1.0), 0.5 * weights
    values, slopes, curvatures = (
        np.array([p.deriv(order)(nodes) if order else p(nodes) for p in basis])
        for order in range(3)
    )
    inertia = (mass * length * weights * values) @ values.T
    bending = (stiffness / length**3 * weights * curvatures) @ curvatures.T
    pulling = (weight * weights * (1.0 - nodes) * slopes) @ slopes.T
    squares, vectors = eigh(bending + pulling, inertia)
    shape = sum((c * p for c, p in zip(vectors[:, 0], basis)), Polynomial([0.0]))
    return Mode(float(np.sqrt(squares[0])), shape)
