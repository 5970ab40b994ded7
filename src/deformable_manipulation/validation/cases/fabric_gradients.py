"""Gradients of fabrics: perturbed copies against the derivative of the mesh's equilibrium."""

from typing import List, Sequence

import numpy as np

from deformable_manipulation.validation.fabric import (
    SUBSTEPS,
    TIME_STEP,
    FabricProperties,
    corners,
    hang,
    rectangle,
)
from deformable_manipulation.validation.references.mesh_equilibrium import MeshEnergy
from deformable_manipulation.validation.result import CaseResult, Curve, Panel, error_check

TITLE = "Gradients of fabrics"
METHOD = """A cloth of 2 m x 2 m with 15 x 15 particles and 1 kg/m^2 has the membrane stiffness E
t and the flexural rigidity D given in the table. It hangs from its corners, which have moved
together to 90 % of their distances. *Level* means that all are at one height, *lifted* that the
displaced one is 0.3 m higher. Copies displace this corner along each axis to both sides and
settle. Central differences show how the height of each vertex changes with the corner's
position. Theory: implicit differentiation of the equilibrium nearest to the settled shape, for
the energy of the mesh implemented independently in Python. The error is the largest of any
vertex: the norm of the difference of the two gradients, which are themselves up to 1.

The table compares displacements of 5 mm. The figure shows other displacements, with the larger
error of both shapes. Stiff or limp cloths have folds that snap within a displacement of some
centimetres. The copies then give the mean change over the snap, which the derivative cannot
predict. Below 2 mm the remaining motion of the settled fabric dominates."""
SIZE = 2.0  # m
PARTICLES = (15, 15)
CLOTHS = {
    "E t 1 kN/m, D 10 mN m": FabricProperties(1.0, 1e-3, 1e2),
    "E t 1 kN/m, D 1 mN m": FabricProperties(1.0, 1e-3, 1e3),
    "E t 10 kN/m, D 10 mN m": FabricProperties(1.0, 1e-4, 1e2),
    "E t 10 kN/m, D 1 mN m": FabricProperties(1.0, 1e-4, 1e3),
}
LIFTS = {"level": 0.0, "lifted": 0.3}  # m
DISPLACEMENTS = (0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001)  # m
COMPARED = 0.005  # m
TOLERANCE = 0.02


def run(quick: bool = False) -> CaseResult:
    """Displace a corner of cloths; quick: of one, as far as is compared."""
    displacements = (COMPARED,) if quick else DISPLACEMENTS
    checks, curves = [], []
    for name, properties in list(CLOTHS.items())[: 1 if quick else None]:
        errors = np.array([_errors(properties, lift, displacements) for lift in LIFTS.values()])
        compared = errors[:, displacements.index(COMPARED)]
        for shape, error in zip(LIFTS, compared):
            quantity = f"error of a gradient, {name}, {shape}"
            checks.append(error_check(quantity, float(error), "", TOLERANCE))
        curves.append(Curve(name, displacements, errors.max(axis=0)))
    axes = ("displacement of the copies [m]", "largest error of a gradient [1]")
    panel = Panel("Copies, level and lifted", *axes, curves, "log", "log", limit=TOLERANCE)
    return CaseResult(TITLE, METHOD, checks, [panel])


def _errors(properties, lift: float, displacements: Sequence[float]) -> List[float]:
    """Largest error [1] of a vertex's gradient for each displacement [m] of the copies."""
    mesh = rectangle((SIZE, SIZE), PARTICLES)
    held = corners(PARTICLES)
    positions = {particle: 0.9 * mesh.vertices[particle] for particle in held}
    positions[held[-1]][2] += lift
    cloth = hang(mesh, properties, positions)
    energy = MeshEnergy(
        mesh.vertices,
        mesh.triangles,
        properties.density,
        properties.stretching_compliance,
        properties.bending_compliance,
    )
    exact = energy.response(energy.minimised(cloth.positions(), held), held)[-1][:, 2]
    return [
        np.linalg.norm(height_gradients(cloth, held[-1], displacement) - exact, axis=1).max()
        for displacement in displacements
    ]


def height_gradients(cloth, particle: int, displacement: float) -> np.ndarray:
    """Change (P, 3) of the height of each vertex with a held particle's position.

    From copies with the particle displaced [m] to both sides along each axis. Raises RuntimeError
    if they do not settle.
    """
    cloth = cloth.clone()
    for axis in np.eye(3):
        for side in (displacement, -displacement):
            cloth.add_copy(particle, side * axis)
    if not cloth.settle(TIME_STEP, SUBSTEPS):
        raise RuntimeError("the copies did not settle")
    heights = cloth.points()[1:, :, 2]
    return (heights[::2] - heights[1::2]).T / (2.0 * displacement)
