"""The rod in PyElastica: a Cosserat rod, integrated explicitly."""

import elastica
import numpy as np

from deformable_manipulation.benchmarks.rod_case import ROPE, RodCase
from deformable_manipulation.benchmarks.rod_model import RodModel

SAFETY = 0.8  # of the largest time step that is stable
SHEAR_CORRECTION = 27.0 / 28.0  # the library's, for a circle


def make(case: RodCase) -> RodModel:
    """The rod of a case."""
    return ElasticaRod(case)


class _Simulator(
    elastica.BaseSystemCollection, elastica.Constraints, elastica.Forcing, elastica.Damping
):
    """The parts of the library that are needed."""


class ElasticaRod(RodModel):
    """Shears and stretches too, as its moduli say.

    The quickest motion limits the time step: the cross-sections' rotation in shear, at
    2/r sqrt(k G / density), whatever the number of elements.
    """

    def __init__(self, case: RodCase):
        self._rope = case.load == ROPE
        rate = np.sqrt(SHEAR_CORRECTION * case.torsion_modulus / case.density) * 2.0 / case.radius
        self.time_step = float(SAFETY * 2.0 / rate)
        self.settings = "Cosserat rod, position Verlet"
        self._rod = elastica.CosseratRod.straight_rod(
            case.segments,
            np.zeros(3),
            np.array([1.0, 0.0, 0.0]),
            np.array([0.0, 0.0, 1.0]),
            case.length,
            case.radius,
            case.density,
            youngs_modulus=case.young_modulus,
            shear_modulus=case.torsion_modulus,
        )
        self._simulator = _Simulator()
        self._simulator.append(self._rod)
        self._hold()
        self._load(case)
        self._simulator.finalize()
        self._stepper = elastica.PositionVerlet()
        self._time = np.float64(0.0)
        # The clamp fixes the direction of the first element, which is that at its middle.
        self._clamp = 0.0 if self._rope else 0.5 * case.segment_length
        self._first = 0 if self._rope else 1
        nodes = case.segment_length * np.arange(case.segments + 1)
        self._arcs = nodes[self._first :] - self._clamp
        self.free_length = case.length - self._clamp

    def _hold(self) -> None:
        if not self._rope:
            self._simulator.constrain(self._rod).using(
                elastica.OneEndFixedBC, constrained_position_idx=(0,), constrained_director_idx=(0,)
            )
            return
        held = []

        class HeldEnd(elastica.GeneralConstraint):
            """Can be reached, to be moved: the library makes it on its own."""

            def __init__(self, *positions, **options):
                super().__init__(*positions, **options)
                held.append(self)

        for node in (0, -1):
            self._simulator.constrain(self._rod).using(
                HeldEnd,
                constrained_position_idx=(node,),
                translational_constraint_selector=np.array([True, True, True]),
            )
        self._held = held

    def _load(self, case: RodCase) -> None:
        self._simulator.add_forcing_to(self._rod).using(
            elastica.GravityForces, acc_gravity=np.array([0.0, 0.0, -case.gravity])
        )
        self._simulator.dampen(self._rod).using(
            elastica.AnalyticalLinearDamper,
            uniform_damping_constant=case.damping,
            time_step=self.time_step,
        )

    def advance(self, count: int) -> None:
        for _ in range(count):
            self._time = self._stepper.step(self._simulator, self._time, self.time_step)

    def place_end(self, x: float, velocity: float) -> None:
        self._held[-1].fixed_positions[:, 0] = (x, 0.0, 0.0)

    def points(self) -> np.ndarray:
        nodes = self._rod.position_collection.T[self._first :, ::2]
        return nodes - (self._clamp, 0.0)

    def arc_lengths(self) -> np.ndarray:
        return self._arcs
