"""The ``simulation`` section."""

import dataclasses
from dataclasses import dataclass
from typing import Optional

from deformable_manipulation.geometry.pose import Vector
from deformable_manipulation.objects.body import GRAVITY, JOINT_SOLVER
from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.parameter import parameter
from deformable_manipulation.reading.readers import (
    Choice,
    Integer,
    Node,
    Number,
    Report,
    Section,
    vector,
)


class Substeps(Integer):
    """A whole number, or ``auto`` (None): what suits the object."""

    type = "whole number or `auto`"

    def __init__(self):
        super().__init__(1, 10000)
        self.allowed += " or auto"

    def __call__(self, node: Node) -> Optional[int]:
        return None if node.value == "auto" else super().__call__(node)


@dataclass(frozen=True)
class SimulationSpec:
    """How the object is simulated and for how long."""

    duration: float = parameter(
        Number("s", above=0.0, at_most=1e6), "Length of the run.", allowed="at least one cycle"
    )
    time_step: float = parameter(
        Number("s", at_least=1e-5, at_most=1.0),
        "Time step of the simulation.",
        default=0.01,
        allowed="a whole number of them makes one cycle, 1 / `controller.rate`",
    )
    substeps: int = parameter(
        Substeps(),
        "Substeps per time step; the cost grows in proportion. `auto`: 2 for rods, which is enough "
        "for `direct` (`gauss_seidel` needs tens), and up to 8 for more than 140 segments that "
        "hardly resist bending; for fabrics, as many as make substeps of 1 ms, or up to ten times "
        "as many where the stiffness of a fine mesh needs them.",
        default=2,
        default_text="`auto`",
    )
    solver: str = parameter(
        Choice("direct", "gauss_seidel"),
        "Solver of a rod's joints: all at once, or one after the other.",
        default=JOINT_SOLVER,
        allowed="rods only",
    )
    gravity: Vector = parameter(
        vector("m/s^2", at_least=-1000.0, at_most=1000.0),
        "Gravity.",
        default=GRAVITY,
    )
    record_rate: float = parameter(
        Number("Hz", above=0.0),
        "Frames per second in `states.npz`.",
        default=10.0,
        allowed="at most `controller.rate`",
    )


# substeps and solver depend on the object where they are left out: for_object() fills them in.
SIMULATION = Section(SimulationSpec, defaults={"substeps": None, "solver": None})


def for_object(report: Report, simulation: SimulationSpec, spec) -> SimulationSpec:
    """The section with what depends on the object filled in; what is not of it is reported.

    Args:
        simulation: as read, with None for what is not given.
        spec: the object.
    """
    if simulation.solver is not None and not spec.has_joints:
        report.add(
            ("simulation", "solver"),
            "applies only to rods; remove it",
            show(simulation.solver),
        )
    filled = {}
    if simulation.substeps is None:
        filled["substeps"] = spec.substeps(simulation.time_step)
    if simulation.solver is None:
        filled["solver"] = SimulationSpec.solver
    return dataclasses.replace(simulation, **filled)
