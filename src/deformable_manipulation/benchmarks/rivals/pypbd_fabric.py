"""The cloth in pyPBD: extended position-based dynamics, springs and isometric bending."""

import numpy as np

from deformable_manipulation.benchmarks.fabric_case import (
    FabricCase,
    FabricModel,
    UndampedFabricModel,
)
from deformable_manipulation.benchmarks.rivals.pypbd_stepper import Stepper


def make(case: FabricCase, iterations: int, step_us: int) -> FabricModel:
    """The cloth of a case, in time steps of so many microseconds."""
    return PyPbdFabric(case, iterations, 1e-6 * step_us)


class PyPbdFabric(UndampedFabricModel):
    """The case's springs and masses. The library's vertical axis is y, the case's is z.

    The library's bending constraint is the energy of a fold, not the fold: its stiffness has no
    counterpart in the case. It gets the flexural rigidity, which hardly matters for a cloth that is
    so heavy.
    """

    def __init__(self, case: FabricCase, iterations: int, time_step: float):
        self.time_step = time_step
        self.settings = f"XPBD distance and isometric bending, iterations: {iterations}"
        self._held = case.held
        self._stepper = Stepper(time_step, iterations)
        model = self._stepper.model
        places = np.array(case.vertices)[:, [0, 2, 1]]
        model.addTriangleModel(list(places), [v for triangle in case.triangles for v in triangle])
        self._particles = model.getParticles()
        for vertex, mass in enumerate(case.masses):
            self._particles.setMass(vertex, 0.0 if vertex in case.held else mass)
        for edge, spring in zip(case.edges, case.springs):
            model.addDistanceConstraint_XPBD(*edge, spring)
        for hinge in case.hinges():
            model.addIsometricBendingConstraint_XPBD(*hinge, 1.0 / case.bending_compliance)
        self._free = [vertex for vertex in range(len(places)) if vertex not in case.held]

    def advance(self, count: int) -> None:
        self._stepper.advance(count)

    def damp(self, factor: float) -> None:
        for vertex in self._free:
            self._particles.setVelocity(vertex, factor * self._particles.getVelocity(vertex))

    def place_held(self, positions: np.ndarray, velocities: np.ndarray) -> None:
        for vertex, place in zip(self._held, positions):
            self._particles.setPosition(vertex, place[[0, 2, 1]])

    def points(self) -> np.ndarray:
        places = [self._particles.getPosition(i) for i in range(self._particles.size())]
        return np.array(places)[:, [0, 2, 1]]
