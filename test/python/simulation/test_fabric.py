"""Fabrics as Python makes them: arrays that are refused, and all meshes that are not."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import Delaunay

from deformable_manipulation import _pbd
from deformable_manipulation.validation.fabric import (
    UPRIGHT,
    FabricProperties,
    Mesh,
    make_fabric,
    rectangle,
)
from deformable_manipulation.validation.references.mesh_equilibrium import MeshEnergy

SQUARE = rectangle((0.4, 0.4), (5, 5))


def fabric_of(vertices=SQUARE.vertices, triangles=SQUARE.triangles, **changed):
    parameters = dict(
        density=1.0,
        thickness=0.001,
        stretching_compliance=1e-4,
        bending_compliance=1e3,
        damping=10.0,
        gravity=(0.0, 0.0, -9.81),
    )
    return _pbd.Fabric(vertices=vertices, triangles=triangles, **{**parameters, **changed})


@pytest.mark.parametrize(
    "triangles",
    [
        SQUARE.triangles.astype(float),
        SQUARE.triangles.ravel(),
        SQUARE.triangles[:, :2],
        SQUARE.triangles[:0],
        "mesh",
        [[0, 1, 2], [0, 1]],
        [[0, 1, 25]],
        [[0, 1, -1]],
        [[0, 1, 2**40]],
    ],
)
def test_triangles_that_are_no_indices_are_refused(triangles):
    with pytest.raises(ValueError, match="triangle"):
        fabric_of(triangles=triangles)


def test_vertices_of_another_shape_are_refused():
    with pytest.raises(ValueError, match=r"shape \(vertices, 3\)"):
        fabric_of(vertices=SQUARE.vertices[:, :2])


def test_problems_are_reported_all_at_once():
    vertices = np.vstack([SQUARE.vertices, [(1.0, 1.0, 1.0)]])
    with pytest.raises(_pbd.ParameterError) as caught:
        fabric_of(vertices, density=-1.0, bending_compliance=np.nan)
    assert [key for key, _, _ in caught.value.problems] == [
        "vertices",
        "density",
        "bending_compliance",
    ]


def test_indices_of_any_width_and_vertices_in_single_precision_are_taken():
    fabric = fabric_of(SQUARE.vertices.astype(np.float32), SQUARE.triangles.astype(np.uint8))
    assert fabric.particle_count == fabric.point_count == 25
    assert fabric.mass == pytest.approx(0.16, rel=1e-6)


def test_no_stiffness_is_infinite_compliance():
    fabric = fabric_of(bending_compliance=np.inf)
    fabric.hold(0)
    fabric.step(0.1, 100)
    assert np.isfinite(fabric.points()).all()


def test_material_changes_by_its_names():
    fabric = fabric_of()
    fabric.set_material({"stretching_compliance": 0.0, "bending_compliance": 10.0, "damping": 1.0})
    with pytest.raises(_pbd.ParameterError, match="stretching_compliance, bending_compliance"):
        fabric.set_material({"young_modulus": 1.0})


@st.composite
def meshes(draw):
    """Meshes of scattered points, bent out of their plane."""
    count = draw(st.integers(4, 25))
    random = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    plane = random.uniform(0.0, 1.0, (count, 2))
    triangles = Delaunay(plane).simplices
    height = draw(st.floats(0.0, 0.2))
    vertices = np.column_stack([plane, height * np.sin(3.0 * plane[:, 0] + plane[:, 1])])
    sides = vertices[triangles[:, 1:]] - vertices[triangles[:, :1]]
    areas = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
    triangles = triangles[areas > 1e-3]
    used = np.unique(triangles)
    return Mesh(vertices[used], np.searchsorted(used, triangles))


def in_one_piece(mesh):
    """Whether all vertices are reached from the first along triangles."""
    reached = {0}
    while True:
        more = set(mesh.triangles[np.isin(mesh.triangles, list(reached)).any(axis=1)].ravel())
        if more <= reached:
            return len(reached) == len(mesh.vertices)
        reached |= more


@settings(max_examples=60, deadline=None)
@given(meshes(), st.data())
def test_any_mesh_with_any_holds_loses_energy_and_keeps_its_weight(mesh, data):
    if not len(mesh.triangles) or not in_one_piece(mesh):
        return
    properties = FabricProperties(stretching_compliance=1e-4, bending_compliance=1e2)
    held = data.draw(
        st.lists(st.integers(0, len(mesh.vertices) - 1), min_size=1, max_size=4, unique=True)
    )
    fabric = make_fabric(mesh, properties)
    energy = MeshEnergy(mesh.vertices, mesh.triangles, 1.0, 1e-4, 1e2)
    assert fabric.mass == pytest.approx(energy.masses.sum())
    for particle in held:
        fabric.hold(particle, "clamped", 0.9 * mesh.vertices[particle], UPRIGHT)
    fabric.lay_out()
    start = energy.energy(fabric.positions())
    for particle in held:
        assert np.allclose(fabric.positions()[particle], 0.9 * mesh.vertices[particle], atol=1e-12)
    for _ in range(300):
        fabric.step(0.01, 10)
    velocities = fabric.velocities()
    kinetic = 0.5 * energy.masses @ np.sum(velocities**2, axis=1)
    assert energy.energy(fabric.positions()) + kinetic < start + 1e-6
    assert fabric.stretch < 0.05
    for particle in held:
        assert np.isfinite(fabric.wrench(particle)[0]).all()
        for other in held:
            straight = np.linalg.norm(mesh.vertices[particle] - mesh.vertices[other])
            assert fabric.free_length(particle, other) >= straight - 1e-9
            assert fabric.free_length(particle, other) == pytest.approx(
                fabric.free_length(other, particle)
            )
