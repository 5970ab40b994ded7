"""A simulation starts in a shape that the object keeps."""

import numpy as np
import pytest

from deformable_manipulation.scenario import scenario_from_mapping
from deformable_manipulation.simulation.factory import make_simulation
from deformable_manipulation.validation.references.mesh_equilibrium import MeshEnergy

HEIGHT = 1.5  # m, of the held corners


def towel():
    """A towel drawn upright, all in one plane, held by its two upper corners with some slack."""
    u, v = np.meshgrid(np.linspace(-0.5, 0.5, 11), np.linspace(0.0, -1.0, 11))
    vertices = np.column_stack((u.ravel(), np.zeros(u.size), v.ravel()))
    corner = (11 * np.arange(10)[:, None] + np.arange(10)).ravel()
    lower = np.column_stack((corner, corner + 11, corner + 1))
    upper = np.column_stack((corner + 1, corner + 11, corner + 12))
    mesh = {"vertices": vertices.tolist(), "triangles": np.vstack((lower, upper)).tolist()}
    return scenario_from_mapping(
        {
            "object": {
                "type": "fabric",
                "material": "felt",
                "mesh": mesh,
                "pose": {"position": [0.0, 0.0, HEIGHT]},
            },
            "agents": {
                "leader": {"particle": 0, "role": "leader", "start": [-0.45, 0.0, HEIGHT]},
                "assistant_1": {"particle": 10, "role": "assistant", "start": [0.45, 0.0, HEIGHT]},
            },
            "leader": {"waypoints": [{"time": 0.0, "position": [0.0, 0.0, 0.0]}]},
            "controller": {"collision": {"offset": 0.05}},
            "simulation": {"duration": 1.0},
        },
        ".",
    )


def elastic_energy(scenario, points):
    """In springs and folds [J]."""
    spec = scenario.object
    mesh = MeshEnergy(
        np.array(spec.vertices),
        np.array(spec.triangles),
        spec.density,
        spec.stretching_compliance,
        spec.bending_compliance,
    )
    return mesh.energy(points) - 9.81 * mesh.masses @ points[:, 2]


def test_a_sheet_drawn_upright_does_not_start_crumpled_in_its_plane():
    scenario = towel()
    simulation = make_simulation(scenario)
    start = simulation.points()[0]
    assert simulation.rest == "stable" and simulation.rest_warning == ""
    assert elastic_energy(scenario, start) < 0.1  # in its plane it is above 1 J
    assert np.ptp(start[:, 1]) > 0.05
    for _ in range(500):
        simulation.advance()
    assert simulation.points()[0] == pytest.approx(start, abs=1e-3)


@pytest.mark.parametrize("young_modulus", [100.0, 1e4])
def test_a_limp_chain_of_many_links_settles(young_modulus):
    scenario = scenario_from_mapping(
        {
            "object": {
                "type": "rod",
                "length": 2.0,
                "radius": 0.004,
                "density": 1000.0,
                "segments": 280,
                "young_modulus": young_modulus,
                "torsion_modulus": young_modulus,
            },
            "agents": {
                "leader": {"particle": 0, "role": "leader", "hold": "pinned", "start": [0, 0, 0]},
                "assistant_1": {
                    "particle": 279,
                    "role": "assistant",
                    "hold": "pinned",
                    "start": [1.5, 0, 0],
                },
            },
            "leader": {"waypoints": [{"time": 0.0, "position": [0.0, 0.0, 0.0]}]},
            "controller": {"collision": {"offset": 0.05}},
            "simulation": {"duration": 1.0},
        },
        ".",
    )
    assert make_simulation(scenario).rest == "stable"


@pytest.mark.parametrize("segments", [100, 3000])
def test_a_finely_divided_rope_is_not_longer(segments):
    """Its lowest point is that of a catenary."""
    from scipy.optimize import brentq

    from deformable_manipulation import _pbd

    length, upright = 2.25, (0.0, 0.0, 0.0, 1.0)
    free = length * (segments - 1) / segments
    span = 0.7 * free
    rod = _pbd.Rod(
        length=length,
        radius=0.0035,
        density=1792.89,
        segments=segments,
        young_modulus=1e5,
        torsion_modulus=3e4,
        stretch="zero",
        damping=10.0,
        solver="direct",
        gravity=(0.0, 0.0, -9.81),
    )
    ends = [
        ("a", 0, "pinned", (0.0, 0.0, 0.0), upright),
        ("b", segments - 1, "pinned", (span, 0.0, 0.0), upright),
    ]
    simulation = _pbd.Simulation(rod, ends, [], time_step=0.01, substeps=2)
    a = brentq(lambda a: 2.0 * a * np.sinh(span / 2.0 / a) - free, span / 20.0, span * 20.0)
    sag = a * (np.cosh(span / 2.0 / a) - 1.0)
    assert -simulation.points()[0][:, 2].min() == pytest.approx(sag, abs=3e-4)
