"""The same hanging cloth in this package and in other libraries: time, and error at rest."""

from functools import partial

import numpy as np

from deformable_manipulation.benchmarks.comparison import COLUMNS, SETTLING_NOTE, Contest, OwnWay
from deformable_manipulation.benchmarks.fabric_case import FabricCase
from deformable_manipulation.benchmarks.package_fabric import SIZE, PackageFabric, make_case
from deformable_manipulation.benchmarks.rivals.catalogue import FABRIC_RIVALS
from deformable_manipulation.benchmarks.subject import Request
from deformable_manipulation.benchmarks.table import Column, Table
from deformable_manipulation.benchmarks.trial import Trial
from deformable_manipulation.validation.references.mesh_equilibrium import MeshEnergy

PARTICLES = (15, 30)  # along a side
OWN = ((0.001, 1), (0.001, 8), (0.0003, 1))  # time step [s], copies

NOTES = (
    "2 m x 2 m, 1 kg/m^2, drawn in by its corners until they are 1.8 m apart; error: largest "
    "distance of a vertex from the nearest exact equilibrium of the mesh, over the size",
    SETTLING_NOTE,
)


def comparison_table(request: Request) -> Table:
    """Simulate the cloth in every library."""
    columns = (Column("particles", "cloth"),) + COLUMNS
    table = Table("comparison", "The same cloth in other libraries", columns, notes=list(NOTES))
    for particles in PARTICLES[:1] if request.quick else PARTICLES:
        contest(particles).add_rows(table, request)
    return table


def contest(particles: int) -> Contest:
    """The cloth of particles x particles, for all libraries."""
    case, size = make_case(particles), f"{particles}x{particles}"
    own = [
        OwnWay(f"{1e3 * step:g} ms", copies, partial(PackageFabric, case, step, copies))
        for step, copies in OWN
    ]
    return Contest(f"cloth {size}", {"particles": size}, case, own, FABRIC_RIVALS, error_of)


def error_of(trial: Trial, case: FabricCase) -> float:
    """Largest distance of a vertex from the nearest equilibrium of the mesh, over the size [1].

    Raises:
        RuntimeError: there is none near.
    """
    points = np.array(trial.points)
    energy = MeshEnergy(
        np.array(case.vertices),
        np.array(case.triangles),
        case.density,
        case.stretching_compliance,
        case.bending_compliance,
    )
    exact = energy.minimised(points, case.held)
    return float(np.linalg.norm(points - exact, axis=1).max()) / SIZE
