"""A rod pinned at its upper end swings under its weight: large planar motion of the continuous rod.

Galerkin's method: the angle of the tangent, from straight down, is a polynomial in the arc length,
a(s, t) = sum of q_k(t) P_k(s), which keeps the rod inextensible. Integrals are Gauss quadratures;
the path of the free end of a rope let go straight changes by 1 mm with more polynomials than here.
The time integration is adaptive (scipy.integrate.solve_ivp, LSODA). Rotary inertia of the
cross-section is left out.
"""

import numpy as np
from numpy.polynomial.legendre import Legendre, leggauss
from scipy.integrate import solve_ivp

POLYNOMIALS = 12
NODES = 32
RELATIVE_TOLERANCE = 1e-8


class SwingingRod:
    """length [m], EI [N m^2], mass per length [kg/m], gravity [m/s^2], damping [1/s].

    With one polynomial the rod is rigid.
    """

    def __init__(self, length, stiffness, mass, gravity, damping, polynomials=POLYNOMIALS):
        self._length = length
        self._gravity = gravity
        self._damping = damping
        nodes, weights = leggauss(NODES)
        self._basis = [Legendre.basis(k, domain=[0.0, length]) for k in range(polynomials)]
        arcs = 0.5 * length * (nodes + 1.0)
        self._values = self._at(arcs)
        slopes = np.array([p.deriv()(arcs) for p in self._basis]).T
        quadrature = 0.5 * length * weights
        self._mass = mass * quadrature
        self._bending = stiffness * (slopes.T * quadrature) @ slopes
        self._integral = self._integral_to(arcs)

    def swing(self, angle: float, times: np.ndarray, arcs: np.ndarray) -> np.ndarray:
        """Points (T, n, 2) [m], x and z from the pin, after release at rest, straight at an angle.

        angle [rad] from straight down, towards x; times (T,) [s] from 0 on, arc lengths (n,) [m].
        """
        start = np.zeros(2 * len(self._basis))
        start[0] = angle
        motion = solve_ivp(
            self._rates,
            (0.0, times[-1]),
            start,
            method="LSODA",
            t_eval=times,
            rtol=RELATIVE_TOLERANCE,
            atol=RELATIVE_TOLERANCE,
        )
        if not motion.success:
            raise RuntimeError(f"the swing was not integrated: {motion.message}")
        angles = motion.y[: len(self._basis)].T @ self._values.T
        to_arcs = self._integral_to(arcs)
        return np.stack([np.sin(angles) @ to_arcs.T, -np.cos(angles) @ to_arcs.T], axis=-1)

    def _at(self, arcs: np.ndarray) -> np.ndarray:
        return np.array([p(arcs) for p in self._basis]).T

    def _integral_to(self, arcs: np.ndarray) -> np.ndarray:
        """Matrix (n, NODES): values at the nodes to integrals from 0 to arcs (n,) [m]."""
        polynomials = [Legendre.basis(k, domain=[0.0, self._length]) for k in range(NODES)]
        nodes = 0.5 * self._length * (leggauss(NODES)[0] + 1.0)
        values = np.array([p(nodes) for p in polynomials]).T
        integrals = np.array([p.integ(lbnd=0.0)(arcs) for p in polynomials]).T
        return np.linalg.solve(values.T, integrals.T).T

    def _rates(self, _, state: np.ndarray) -> np.ndarray:
        q, rate = np.split(state, 2)
        angles, spin = self._values @ q, self._values @ rate
        cosine, sine = np.cos(angles), np.sin(angles)
        x_rates = self._integral @ (cosine[:, None] * self._values)
        z_rates = self._integral @ (sine[:, None] * self._values)
        inertia = (x_rates.T * self._mass) @ x_rates + (z_rates.T * self._mass) @ z_rates
        x_turning = -self._integral @ (sine * spin**2)
        z_turning = self._integral @ (cosine * spin**2)
        force = -x_rates.T @ (self._mass * x_turning)
        force -= z_rates.T @ (self._mass * (z_turning + self._gravity))
        force -= self._bending @ q
        return np.concatenate([rate, np.linalg.solve(inertia, force) - self._damping * rate])
