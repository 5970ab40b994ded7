"""The ``knowledge`` section: what the controllers of a run without ROS do not know exactly."""

from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.readers import Integer, Number, Report, Section
from deformable_manipulation.scenario.spec import ControllerSpec, KnowledgeSpec

_FACTOR = Number("1", at_least=0.01, at_most=100.0)

KNOWLEDGE = Section(
    KnowledgeSpec,
    {
        "pose_noise": Number("m", at_least=0.0, at_most=0.1),
        "pose_delay": Number("s", at_least=0.0),
        "stiffness_factor": _FACTOR,
        "density_factor": _FACTOR,
        "dropped_cycles": Number("1", at_least=0.0, at_most=0.99),
        "seed": Integer(0, 2**31 - 1),
    },
)


def check_delay(report: Report, controller: ControllerSpec, knowledge: KnowledgeSpec) -> None:
    """Poses that are not lost when they arrive."""
    if knowledge.pose_delay >= controller.timeout:
        report.add(
            ("knowledge", "pose_delay"),
            "must be below controller.timeout ({:g} s), the age at which a pose counts as "
            "lost".format(controller.timeout),
            show(knowledge.pose_delay),
        )
