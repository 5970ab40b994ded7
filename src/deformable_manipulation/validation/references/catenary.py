"""A perfectly flexible, inextensible chain between two points in a vertical plane."""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq


@dataclass(frozen=True)
class Catenary:
    """z = scale cosh((x - lowest) / scale) + constant, from the origin to the other end.

    ``scale`` [m] is the horizontal tension over the weight per length.
    """

    length: float
    scale: float
    lowest: float

    def positions(self, arc_lengths: np.ndarray) -> np.ndarray:
        """Points (n, 2), x and z [m], at arc lengths (n,) [m] from the origin."""
        start = np.sinh(-self.lowest / self.scale)
        slopes = np.asarray(arc_lengths) / self.scale + start
        heights = self.scale * (np.sqrt(1.0 + slopes**2) - np.sqrt(1.0 + start**2))
        return np.stack([self.lowest + self.scale * np.arcsinh(slopes), heights], axis=-1)

    def angles(self, arc_lengths: np.ndarray) -> np.ndarray:
        """Angle (n,) [rad] of the tangent above the x axis."""
        start = np.sinh(-self.lowest / self.scale)
        return np.arctan(np.asarray(arc_lengths) / self.scale + start)


def solve_catenary(length: float, width: float, height: float = 0.0) -> Catenary:
    """Find the chain of a length [m] that ends at (width, height) [m] from its start, width > 0.

    From sqrt(length^2 - height^2) = 2 scale sinh(width / (2 scale)) and
    height = 2 scale sinh(width / (2 scale)) sinh((width - 2 lowest) / (2 scale)).

    Raises:
        ValueError: the chain does not reach.
    """
    chord = np.hypot(width, height)
    if not (width > 0.0 and chord < length):
        raise ValueError(f"a chain of {length:g} m does not hang over ({width:g}, {height:g}) m")
    ratio = np.sqrt(length**2 - height**2) / width
    half = brentq(lambda u: np.sinh(u) / u - ratio, 1e-9, 50.0, xtol=1e-15, rtol=1e-14)
    scale = 0.5 * width / half
    middle = scale * np.arcsinh(height / (2.0 * scale * np.sinh(half)))
    return Catenary(length, scale, 0.5 * width - middle)
