"""The rods that are validated, and the simulation of them."""

from dataclasses import dataclass, replace
from typing import Sequence, Tuple

import numpy as np

from deformable_manipulation import _pbd

GRAVITY = 9.81  # m/s^2
TIME_STEP = 0.01  # s
SUBSTEPS = 2


@dataclass(frozen=True)
class RodProperties:
    """A straight rod of circular cross-section; defaults are the paper's rope."""

    length: float = 2.25  # m
    radius: float = 0.0035  # m
    density: float = 1792.89  # kg/m^3
    young_modulus: float = 30e6  # Pa
    torsion_modulus: float = 10e6  # Pa

    @property
    def bending_stiffness(self) -> float:
        """E I [N m^2]."""
        return self.young_modulus * np.pi * self.radius**4 / 4.0

    @property
    def torsion_stiffness(self) -> float:
        """G J [N m^2]."""
        return self.torsion_modulus * np.pi * self.radius**4 / 2.0

    @property
    def mass_per_length(self) -> float:
        """Mass [kg/m]."""
        return self.density * np.pi * self.radius**2

    @property
    def weight_per_length(self) -> float:
        """Weight [N/m]."""
        return self.mass_per_length * GRAVITY

    def with_young_modulus(self, young_modulus: float) -> "RodProperties":
        """The same rod of another material, of the same ratio of moduli."""
        ratio = self.torsion_modulus / self.young_modulus
        return replace(self, young_modulus=young_modulus, torsion_modulus=ratio * young_modulus)


ROPE = RodProperties()
STIFF_ROD = ROPE.with_young_modulus(30e9)


def make_rod(
    properties: RodProperties,
    segments: int,
    gravity: Sequence[float] = (0.0, 0.0, -GRAVITY),
    **options,
) -> _pbd.Rod:
    """Build the simulated rod, straight along x; options as ``_pbd.Rod`` has them.

    ``properties``: anything with the length, radius, density and moduli of RodProperties.
    """
    return _pbd.Rod(
        length=properties.length,
        radius=properties.radius,
        density=properties.density,
        segments=segments,
        young_modulus=properties.young_modulus,
        torsion_modulus=properties.torsion_modulus,
        gravity=gravity,
        **{"stretch": "zero", "damping": 10.0, "solver": "direct", **options},
    )


def pitched(angle: float) -> Tuple[float, float, float, float]:
    """Orientation whose tangent lies in the plane x-z, at an angle [rad] above x."""
    return (0.0, -np.sin(0.5 * angle), 0.0, np.cos(0.5 * angle))


def grip_arc_lengths(properties: RodProperties, segments: int) -> np.ndarray:
    """Arc lengths (N,) [m] of the segments' centres from the first one's, where a grip is."""
    return properties.length / segments * np.arange(segments)


def joint_arc_lengths(properties: RodProperties, segments: int) -> np.ndarray:
    """Arc lengths (N - 1,) [m] of the joints, from the first segment's centre."""
    return grip_arc_lengths(properties, segments)[:-1] + 0.5 * properties.length / segments


def hang(
    properties: RodProperties, segments: int, chord: Sequence[float], hold: str, **options
) -> _pbd.Rod:
    """Hang the rod from grips at the origin and at a chord (x, z) [m], level there; at rest."""
    rod = make_rod(properties, segments, **options)
    rod.hold(0, hold, (0.0, 0.0, 0.0), pitched(0.0))
    rod.hold(segments - 1, hold, (chord[0], 0.0, chord[1]), pitched(0.0))
    rod.lay_out()
    settle(rod)
    return rod


def settle(rod, substeps: int = SUBSTEPS, speed: float = 1e-9, time_limit: float = 600.0) -> None:
    """Step until the rod rests: nothing moves or turns faster than ``speed`` [m/s].

    ``time_limit`` [s] is simulated time. Raises RuntimeError if it moves longer than that.
    """
    if not rod.settle(TIME_STEP, substeps, speed, time_limit):
        raise RuntimeError(f"the rod still moves after {time_limit:g} s")


def move(
    rod, particle: int, shift: Sequence[float], turn: Sequence[float], duration: float
) -> None:
    """Move a held segment by (3,) [m] and turn it by a rotation vector (3,) [rad], steadily."""
    rod.set_velocity(particle, np.array(shift) / duration, np.array(turn) / duration)
    for _ in range(int(round(duration / TIME_STEP))):
        rod.step(TIME_STEP, SUBSTEPS)
    rod.set_velocity(particle, (0.0, 0.0, 0.0))
