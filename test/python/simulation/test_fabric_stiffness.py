"""A fabric has the stiffness of its material at every resolution, or says that it has not."""

import numpy as np
import pytest

from deformable_manipulation import _pbd
from deformable_manipulation.objects.fabric import FabricSpec

GRAVITY = 9.81  # m/s^2
UPRIGHT = (0.0, 0.0, 0.0, 1.0)
TIME_STEP = 0.01  # s
# Stretching compliance [m/N], density [kg/m^2] and bending compliance [1/(N m)].
FELT, DENIM, TARPAULIN = (3.3e-4, 0.6, 440.0), (1.05e-4, 0.324, 25e3), (1e-5, 0.65, 5e3)


def mesh(cells):
    """Vertices and triangles of 0.3 m x 1 m, with so many cells per metre, row by row downwards."""
    columns = round(0.3 * cells) + 1
    u, v = np.meshgrid(np.arange(columns) / cells, -np.arange(cells + 1) / cells)
    corner = (columns * np.arange(cells)[:, None] + np.arange(columns - 1)).ravel()
    lower = np.column_stack((corner, corner + 1, corner + columns))
    upper = np.column_stack((corner + 1, corner + columns + 1, corner + columns))
    return np.column_stack((u.ravel(), 0.0 * u.ravel(), v.ravel())), np.vstack((lower, upper))


def strip(material, cells):
    """A strip to hang from its upper edge, and the number of its columns."""
    vertices, triangles = mesh(cells)
    compliance, density, bending_compliance = material
    fabric = _pbd.Fabric(
        vertices=vertices,
        triangles=triangles,
        density=density,
        thickness=1e-3,
        stretching_compliance=compliance,
        bending_compliance=bending_compliance,
        damping=10.0,
        gravity=(0.0, 0.0, -GRAVITY),
    )
    return fabric, round(0.3 * cells) + 1


def extension(fabric, columns, substeps):
    """Of the strip under its own weight [m]."""
    places = fabric.points()[0]
    holds = [(f"a{i}", i, "pinned", tuple(places[i]), UPRIGHT) for i in range(columns)]
    simulation = _pbd.Simulation(fabric, holds, [], time_step=TIME_STEP, substeps=substeps)
    lowest = simulation.points()[0][-columns:, 2].mean()
    return -1.0 - lowest, simulation


@pytest.mark.parametrize("material", [FELT, DENIM, TARPAULIN])
def test_a_strip_extends_by_its_weight_times_its_compliance(material):
    fabric, columns = strip(material, 14)
    substeps = fabric.substeps_for_stiffness(TIME_STEP, 10, 1000)
    longer, simulation = extension(fabric, columns, substeps)
    compliance, density, _ = material
    assert longer == pytest.approx(0.5 * density * GRAVITY * compliance, rel=0.05, abs=2e-6)
    assert simulation.softness == ""


def test_too_few_substeps_are_told():
    fabric, columns = strip(DENIM, 14)
    needed = fabric.substeps_for_stiffness(TIME_STEP, 10, 1000)
    effective = fabric.effective_compliance(TIME_STEP / 10)
    longer, simulation = extension(fabric, columns, 10)
    assert longer == pytest.approx(0.5 * DENIM[1] * GRAVITY * effective, rel=0.2)
    assert effective > 5.0 * DENIM[0]
    assert "with 10 substeps this mesh behaves like one of" in simulation.softness
    assert f"simulation.substeps: {needed} keeps" in simulation.softness
    assert f"takes {needed / 10:.3g} times as long" in simulation.softness


def test_an_inextensible_fabric_yields_a_little():
    fabric, columns = strip((0.0, 0.5, 1e4), 7)
    _, simulation = extension(fabric, columns, 10)
    assert "instead of 0 m/N" in simulation.softness
    assert "bring it closer to that" in simulation.softness


@pytest.mark.parametrize(
    "compliance, cells, least, most",
    [(3e-3, 7, 10, 10), (1.05e-4, 14, 11, 99), (1.05e-4, 28, 100, 100), (0.0, 7, 10, 10)],
)
def test_auto_takes_what_the_stiffness_needs_up_to_ten_times_the_usual(
    compliance, cells, least, most
):
    vertices, triangles = mesh(cells)
    spec = FabricSpec(
        vertices=tuple(map(tuple, vertices.tolist())),
        triangles=tuple(map(tuple, triangles.tolist())),
        density=0.324,
        thickness=1e-3,
        stretching_compliance=compliance,
        bending_compliance=25e3,
    )
    assert least <= spec.substeps(TIME_STEP) <= most
