"""The ``knowledge`` section: what the controllers of a run without ROS do not know exactly."""

import dataclasses
from dataclasses import dataclass
from typing import Optional

from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.parameter import parameter
from deformable_manipulation.reading.readers import (
    Choice,
    Flag,
    Integer,
    Node,
    Number,
    Report,
    Section,
)
from deformable_manipulation.scenario.barriers import BARRIERS
from deformable_manipulation.scenario.controller import ControllerSpec

HONEST, OPPOSITE, DELAYED, SCALED, RANDOM = "honest", "opposite", "delayed", "scaled", "random"

OWN, MUJOCO = "own", "mujoco"  # worlds

_REFINEMENT = 3  # of a rod in another world: real ropes are not made of segments
_FACTOR = Number("1", at_least=0.01, at_most=100.0)


class _OddNumber(Integer):
    """Odd, so that a finer piece lies where the centre of a segment is."""

    def __init__(self, at_most: int):
        super().__init__(1, at_most)
        self.allowed = "1, 3, 5 to {}".format(at_most)

    def __call__(self, node: Node) -> int:
        value = super().__call__(node)
        if value % 2 == 0:
            node.fail("must be odd: " + self.allowed)
        return value


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
    world: str = parameter(
        Choice(OWN, MUJOCO),
        "What simulates the true object: this package, or "
        "[MuJoCo](real_objects.md#a-world-that-is-not-ours). The controllers see it only through "
        "poses of the agents.",
        default=OWN,
    )
    refinement: int = parameter(
        _OddNumber(99),
        "Pieces of the true rod per segment of the assumed one. Real ropes are not made of "
        "segments.",
        default=1,
        default_text="3 for rods in the world `mujoco`, else 1",
        allowed="1 for fabrics; at most 300 pieces in the world `mujoco`",
    )
    dropped_cycles: float = parameter(
        Number("1", at_least=0.0, at_most=0.99),
        "Probability that a controller gets no new state in a cycle. It repeats its last command "
        "for at most `controller.timeout`.",
        default=0.0,
    )
    camera_rate: float = parameter(
        Number("Hz", at_least=0.0, at_most=1000.0),
        "How often a camera sees points of the object, which [correct](#correction) the model. 0: "
        "there is none.",
        default=0.0,
    )
    camera_points: int = parameter(
        Integer(1, 10000), "Points in each picture, evenly along the object.", default=20
    )
    camera_noise: float = parameter(
        Number("m", at_least=0.0, at_most=0.1),
        "Standard deviation of every coordinate of such a point.",
        default=0.0,
    )
    camera_delay: float = parameter(
        Number("s", at_least=0.0, at_most=1.0), "Age of a picture when it arrives.", default=0.0
    )
    camera_hidden: float = parameter(
        Number("1", at_least=0.0, at_most=1.0),
        "Part of the object that is hidden: a piece that wanders along it.",
        default=0.0,
    )
    camera_places: bool = parameter(
        Flag(),
        "Whether the camera knows where along the object a point is, as with markers. Otherwise "
        "it is the nearest place of the model.",
        default=True,
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


# refinement depends on the object where it is left out: for_object() fills it in.
KNOWLEDGE = Section(KnowledgeSpec, defaults={"refinement": None})


def for_object(report: Report, knowledge: KnowledgeSpec, spec) -> KnowledgeSpec:
    """The section with what depends on the object filled in; what is not of it is reported.

    Args:
        knowledge: as read, with None for what is not given.
        spec: the object.
    """
    finer: Optional[int] = knowledge.refinement
    if finer is None:
        finer = _REFINEMENT if knowledge.world == MUJOCO and not spec.is_surface else 1
    elif spec.is_surface and finer > 1:
        report.add(("knowledge", "refinement"), "must be 1 for fabrics", show(finer))
        finer = 1
    return dataclasses.replace(knowledge, refinement=finer)


def check_delay(report: Report, controller: ControllerSpec, knowledge: KnowledgeSpec) -> None:
    """Poses that are not lost when they arrive."""
    if knowledge.pose_delay >= controller.timeout:
        report.add(
            ("knowledge", "pose_delay"),
            "must be below controller.timeout ({:g} s), the age at which a pose counts as "
            "lost".format(controller.timeout),
            show(knowledge.pose_delay),
        )


def check_loads(report: Report, controller: ControllerSpec, knowledge: KnowledgeSpec) -> None:
    """Limits of loads are judged in a world that tells them, in the pieces of the model."""
    limits = [name for name in controller.barriers if BARRIERS[name].is_load]
    if limits and (knowledge.world != OWN or knowledge.refinement > 1):
        report.add(
            ("knowledge", "world" if knowledge.world != OWN else "refinement"),
            "cannot be used with limits of what the object bears, which are not known of such an "
            "object: {}. Leave them out, or use the world own with refinement 1".format(
                ", ".join(limits)
            ),
        )
