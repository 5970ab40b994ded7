"""The ``simulation`` section."""

import dataclasses
from typing import Optional

from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.readers import (
    Choice,
    Integer,
    Node,
    Number,
    Report,
    Section,
    vector,
)
from deformable_manipulation.scenario.spec import SimulationSpec


class Substeps(Integer):
    """A whole number, or ``auto`` (None): what suits the object."""

    def __init__(self):
        super().__init__(1, 10000)
        self.allowed += " or auto"

    def __call__(self, node: Node) -> Optional[int]:
        return None if node.value == "auto" else super().__call__(node)


SIMULATION = Section(
    SimulationSpec,
    {
        "duration": Number("s", above=0.0, at_most=1e6),
        "time_step": Number("s", at_least=1e-5, at_most=1.0),
        "substeps": Substeps(),
        "solver": Choice("direct", "gauss_seidel"),
        "gravity": vector("m/s^2", at_least=-1000.0, at_most=1000.0),
        "record_rate": Number("Hz", above=0.0),
    },
    # What they are depends on the object: for_object() fills them in.
    defaults={"substeps": None, "solver": None},
)


def for_object(report: Report, simulation: SimulationSpec, spec) -> SimulationSpec:
    """The section with what depends on the object filled in; what is not of it is reported.

    :param simulation: as read, with None for what is not given.
    :param spec: the object.
    """
    if simulation.solver is not None and not spec.has_joint_solver:
        report.add(
            ("simulation", "solver"),
            "is of a rod's joints; remove it",
            show(simulation.solver),
        )
    filled = {}
    if simulation.substeps is None:
        filled["substeps"] = spec.auto_substeps(simulation.time_step)
    if simulation.solver is None:
        filled["solver"] = SimulationSpec.solver
    return dataclasses.replace(simulation, **filled)
