"""Fabrics at rest against the equilibrium of their mesh, springs in series and the elastica."""

import numpy as np
import pytest

from deformable_manipulation.validation.fabric import (
    FabricProperties,
    corners,
    hang,
    rectangle,
)
from deformable_manipulation.validation.references.elastica import solve_cantilever
from deformable_manipulation.validation.references.mesh_equilibrium import MeshEnergy

GRAVITY = 9.81  # m/s^2
CLOTH = rectangle((2.0, 2.0), (15, 15))
CORNERS = corners((15, 15))


def energy_of(mesh, properties):
    return MeshEnergy(
        mesh.vertices,
        mesh.triangles,
        properties.density,
        properties.stretching_compliance,
        properties.bending_compliance,
    )


def moved_to_equilibrium(mesh, properties, holds, **options):
    """Largest distance [m] of a settled fabric from the least energy near it, and the fabric."""
    fabric = hang(mesh, properties, holds, **options)
    settled = fabric.positions()
    exact = energy_of(mesh, properties).minimised(settled, list(holds))
    return np.linalg.norm(settled - exact, axis=1).max(), fabric


def test_the_reference_has_the_derivatives_of_its_energy():
    properties = FabricProperties()
    mesh = rectangle((0.4, 0.3), (5, 4))
    energy = energy_of(mesh, properties)
    random = np.random.default_rng(1)
    x = mesh.vertices + 0.01 * random.standard_normal(mesh.vertices.shape)
    step = 1e-6 * random.standard_normal(x.shape)
    change = energy.energy(x + step) - energy.energy(x - step)
    assert change == pytest.approx(2.0 * np.sum(energy.gradient(x) * step), rel=1e-7)
    change = (energy.gradient(x + step) - energy.gradient(x - step)).ravel()
    assert change == pytest.approx(2.0 * energy.hessian(x, convex=False) @ step.ravel(), rel=1e-5)


def test_turning_and_moving_leave_the_energy_as_it_is():
    mesh = rectangle((0.4, 0.3), (5, 4))
    energy = energy_of(mesh, FabricProperties())
    random = np.random.default_rng(2)
    bent = mesh.vertices + 0.02 * random.standard_normal(mesh.vertices.shape)
    rotation = np.linalg.qr(random.standard_normal((3, 3)))[0]
    moved = bent @ rotation.T + (1.0, 2.0, 0.0)
    weights = [GRAVITY * energy.masses @ x[:, 2] for x in (bent, moved)]
    inner = [energy.energy(x) - weight for x, weight in zip((bent, moved), weights)]
    assert inner[0] == pytest.approx(inner[1], rel=1e-12)


@pytest.mark.parametrize("part", [0.8, 0.95])
@pytest.mark.parametrize("compliance", [1e-4, 1e-3])
def test_a_cloth_between_its_corners_is_in_equilibrium(part, compliance):
    properties = FabricProperties(stretching_compliance=compliance)
    holds = {i: part * CLOTH.vertices[i] for i in CORNERS}
    moved, fabric = moved_to_equilibrium(CLOTH, properties, holds)
    assert moved < 0.001 * 2.0
    fabric.step(0.01, 10)
    weight = np.sum([fabric.wrench(i)[0] for i in CORNERS], axis=0)
    assert weight == pytest.approx((0.0, 0.0, -4.0 * GRAVITY), abs=1e-3 * 4.0 * GRAVITY)


def test_smaller_substeps_come_closer_to_the_equilibrium():
    properties = FabricProperties(stretching_compliance=2e-5, bending_compliance=1e1)
    holds = {i: 0.95 * CLOTH.vertices[i] for i in CORNERS}
    moved = [
        moved_to_equilibrium(CLOTH, properties, holds, substeps=substeps)[0]
        for substeps in (5, 10, 20, 40)
    ]
    assert moved == sorted(moved, reverse=True)
    assert moved[2] < 0.002 * 2.0


def test_a_hanging_strip_stretches_as_springs_in_series():
    """All vertical edges of a row of cells share its load; the diagonals carry none."""
    rows, columns, size = 21, 3, 1.0
    mesh = rectangle((0.1, size), (columns, rows))
    properties = FabricProperties(stretching_compliance=2e-3, bending_compliance=1e3)
    upper = range((rows - 1) * columns, rows * columns)
    fabric = hang(mesh, properties, {i: (mesh.vertices[i, 0], 0.0, 1.0) for i in upper})
    masses = energy_of(mesh, properties).masses.reshape(rows, columns).sum(axis=1)
    below = GRAVITY * np.cumsum(masses)[:-1]  # N, on the springs above each row
    cell = size / (rows - 1)
    extension = np.sum(below * cell * properties.stretching_compliance / 0.1)
    lowest = fabric.positions()[:columns, 2].mean()
    measured = 1.0 - lowest - size
    assert measured == pytest.approx(extension, rel=0.01)


@pytest.mark.parametrize("load", [10.0, 100.0])
def test_a_cantilevered_strip_droops_as_the_elastica(load):
    """Peirce's test; two held rows clamp the strip midway between them."""
    columns, rows, cell = 13, 4, 0.025
    mesh = rectangle((cell * (columns - 1), cell * (rows - 1)), (columns, rows), alternate=True)
    length = cell * (columns - 1.5)
    density = 0.5  # kg/m^2
    rigidity = density * GRAVITY * length**3 / load  # N m
    properties = FabricProperties(density, 1e-5, 1.0 / rigidity)
    held = {i: mesh.vertices[i] for i in range(rows * columns) if i % columns < 2}
    strip = hang(mesh, properties, held, substeps=40)
    width = cell * (rows - 1)
    shape = solve_cantilever(length, rigidity * width, density * GRAVITY * width)
    drop = -strip.positions()[columns - 1 :: columns, 2].mean()
    assert drop == pytest.approx(-shape.positions([length])[0, 1], rel=0.03)


def test_the_derivative_of_an_equilibrium_is_that_of_equilibria_nearby():
    properties = FabricProperties(stretching_compliance=1e-3, bending_compliance=1e2)
    mesh = rectangle((1.0, 1.0), (5, 5))
    held = corners((5, 5))
    energy = energy_of(mesh, properties)
    fabric = hang(mesh, properties, {i: 0.9 * mesh.vertices[i] for i in held})
    exact = energy.minimised(fabric.positions(), held)
    response = energy.response(exact, held)
    assert response.sum(axis=0) == pytest.approx(np.tile(np.eye(3), (25, 1, 1)), abs=1e-9)
    displacement = np.array([1.0, -2.0, 3.0]) * 1e-5
    sides = []
    for side in (displacement, -displacement):
        displaced = exact.copy()
        displaced[held[2]] += side
        sides.append(energy.minimised(displaced, held))
    change = (sides[0] - sides[1]) / 2.0
    assert change == pytest.approx(response[2] @ displacement, abs=1e-4 * 1e-5)
