"""The fabric of this package, for the comparison with others."""

import numpy as np

from deformable_manipulation import _pbd
from deformable_manipulation.benchmarks.copies import add_copies
from deformable_manipulation.benchmarks.fabric_case import FabricCase, FabricModel
from deformable_manipulation.validation.fabric import (
    UPRIGHT,
    FabricProperties,
    Mesh,
    corners,
    make_fabric,
    rectangle,
)
from deformable_manipulation.validation.references.mesh_equilibrium import GRAVITY, MeshEnergy

SIZE = 2.0  # m
PART = 0.9  # of the cloth's size: distance of the corners from each other
CLOTH = FabricProperties()


def make_case(particles: int) -> FabricCase:
    """A square cloth of particles x particles, held at its corners."""
    mesh = rectangle((SIZE, SIZE), (particles, particles))
    vertices = mesh.vertices - (0.5 * SIZE, 0.5 * SIZE, 0.0)
    energy = MeshEnergy(
        vertices,
        mesh.triangles,
        CLOTH.density,
        CLOTH.stretching_compliance,
        CLOTH.bending_compliance,
    )
    return FabricCase(
        vertices.tolist(),
        mesh.triangles.tolist(),
        energy.masses.tolist(),
        energy.edges.tolist(),
        energy.springs.tolist(),
        CLOTH.density,
        CLOTH.stretching_compliance,
        CLOTH.bending_compliance,
        list(corners((particles, particles))),
        PART,
        GRAVITY,
        CLOTH.damping,
    )


def make_held(case: FabricCase, part: float) -> _pbd.Fabric:
    """The cloth of a case, laid out between its held vertices at a part of their distance."""
    mesh = Mesh(np.array(case.vertices), np.array(case.triangles))
    fabric = make_fabric(mesh, CLOTH, gravity=(0.0, 0.0, -case.gravity))
    for vertex in case.held:
        fabric.hold(vertex, "pinned", part * mesh.vertices[vertex], UPRIGHT)
    fabric.lay_out()
    return fabric


class PackageFabric(FabricModel):
    """The cloth itself is what is looked at; its copies are carried along."""

    def __init__(self, case: FabricCase, time_step: float, copies: int = 1):
        self.time_step = time_step
        self.settings = "springs and folds, one sweep per step"
        self._held = case.held
        self._fabric = make_held(case, 1.0)
        add_copies(self._fabric, case.held[0], copies)

    def advance(self, count: int) -> None:
        self._fabric.step(count * self.time_step, count)

    def place_held(self, positions: np.ndarray, velocities: np.ndarray) -> None:
        # Their places follow from their velocities, step by step.
        for vertex, velocity in zip(self._held, velocities):
            self._fabric.set_velocity(vertex, velocity)

    def points(self) -> np.ndarray:
        return self._fabric.positions()
