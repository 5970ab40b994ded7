"""The rods that all libraries simulate; plain numbers, for they go to other interpreters."""

import math
from dataclasses import dataclass

from deformable_manipulation.benchmarks.rod_model import RodModel
from deformable_manipulation.benchmarks.trial import Case

ROPE = "rope"
CANTILEVER = "cantilever"


@dataclass(frozen=True)
class RodCase(Case):
    """A straight rod along x, at rest, whose first end is held; gravity is against z.

    ``rope``: both ends are held, free to turn; the last is drawn in until both are ``span`` apart.
    ``cantilever``: the first end is clamped along x, the last one is free.
    """

    load: str
    segments: int
    length: float  # m
    radius: float  # m
    density: float  # kg/m^3
    young_modulus: float  # Pa
    torsion_modulus: float  # Pa
    span: float = 1.5  # m
    gravity: float = 9.81  # m/s^2
    damping: float = 10.0  # 1/s, of all motion: forces of -damping x mass x velocity

    @property
    def drawn_in(self) -> bool:
        """Whether the last end moves at first."""
        return self.load == ROPE

    def draw_in(self, model: RodModel, progress: float, rate: float) -> None:
        way = model.free_length - self.span
        model.place_end(model.free_length - way * progress, -way * rate)

    @property
    def segment_length(self) -> float:
        """Length of a segment [m]."""
        return self.length / self.segments

    @property
    def segment_mass(self) -> float:
        """Mass of a segment [kg]."""
        return self.density * math.pi * self.radius**2 * self.segment_length

    @property
    def bending_stiffness(self) -> float:
        """E I [N m^2]."""
        return self.young_modulus * math.pi * self.radius**4 / 4.0

    @property
    def weight_per_length(self) -> float:
        """Weight [N/m]."""
        return self.gravity * self.density * math.pi * self.radius**2
