"""The ``knowledge`` section: what the controllers of a run without ROS do not know exactly."""

import dataclasses
from dataclasses import dataclass

from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.parameter import parameter
from deformable_manipulation.reading.readers import Choice, Integer, Number, Report, Section
from deformable_manipulation.scenario.controller import ControllerSpec

HONEST, OPPOSITE, DELAYED, SCALED, RANDOM = "honest", "opposite", "delayed", "scaled", "random"

_FACTOR = Number("1", at_least=0.01, at_most=100.0)


@dataclass(frozen=True)
class KnowledgeSpec:
    """What the controllers do not know exactly, in runs without ROS; the defaults are all of it."""

    pose_noise: float = parameter(
        Number("m", at_least=0.0, at_most=0.1),
        "Standard deviation of every component of a held point, drawn anew in every cycle.",
        default=0.0,
    )
    pose_delay: float = parameter(
        Number("s", at_least=0.0),
        "Age of the newest poses.",
        default=0.0,
        allowed="below `controller.timeout`",
    )
    stiffness_factor: float = parameter(
        _FACTOR,
        "True stiffness divided by the assumed one: moduli of a rod, 1 / compliances of a fabric.",
        default=1.0,
    )
    density_factor: float = parameter(
        _FACTOR, "True density divided by the assumed one.", default=1.0
    )
    dropped_cycles: float = parameter(
        Number("1", at_least=0.0, at_most=0.99),
        "Probability that a controller gets no new state in a cycle. It repeats its last command "
        "for at most `controller.timeout`.",
        default=0.0,
    )
    intent: str = parameter(
        Choice(HONEST, OPPOSITE, DELAYED, SCALED, RANDOM),
        "What the leader announces: its path; the opposite way; where it was to be 1 s before; "
        "twice the way; a random velocity, another one every second. Has no effect without "
        "`controller.horizon.leader`.",
        default=HONEST,
    )
    seed: int = parameter(
        Integer(0, 2**31 - 1),
        "Seed of the noise and the drops. The same seed gives the same run.",
        default=0,
    )

    @property
    def perfect(self) -> bool:
        """Whether there is nothing that the controllers do not know exactly."""
        return dataclasses.replace(self, seed=0) == KnowledgeSpec()

    @property
    def sees_object(self) -> bool:
        """Whether the controllers see the object itself, at once and in every cycle."""
        return dataclasses.replace(self, intent=HONEST).perfect


KNOWLEDGE = Section(KnowledgeSpec)


def check_delay(report: Report, controller: ControllerSpec, knowledge: KnowledgeSpec) -> None:
    """Poses that are not lost when they arrive."""
    if knowledge.pose_delay >= controller.timeout:
        report.add(
            ("knowledge", "pose_delay"),
            "must be below controller.timeout ({:g} s), the age at which a pose counts as "
            "lost".format(controller.timeout),
            show(knowledge.pose_delay),
        )
