"""The ``simulation`` section."""

from deformable_manipulation.scenario.readers import Choice, Integer, Number, Section, vector
from deformable_manipulation.scenario.spec import SimulationSpec

SIMULATION = Section(
    SimulationSpec,
    {
        "duration": Number("s", above=0.0, at_most=1e6),
        "time_step": Number("s", at_least=1e-5, at_most=1.0),
        "substeps": Integer(1, 10000),
        "solver": Choice("direct", "gauss_seidel"),
        "gravity": vector("m/s^2"),
        "record_rate": Number("Hz", above=0.0),
    },
)
