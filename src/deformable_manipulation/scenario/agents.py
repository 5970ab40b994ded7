"""The ``agents`` section: who holds which particle, in which role, from where."""

import re
from dataclasses import dataclass
from functools import partial
from typing import Dict, Iterable, Optional, Tuple

from deformable_manipulation.geometry.pose import Quaternion, Vector
from deformable_manipulation.objects.grip import GRIP_LENGTH
from deformable_manipulation.objects.spec import ObjectSpec
from deformable_manipulation.reading.errors import key_text, show
from deformable_manipulation.reading.parameter import parameter
from deformable_manipulation.reading.readers import (
    Choice,
    Integer,
    Items,
    Node,
    Section,
    UnitQuaternion,
    Unreadable,
    position,
    read_all,
)
from deformable_manipulation.scenario.grips import Draft, held_object

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")

LEADER = "leader"
ASSISTANT = "assistant"
PINNED = "pinned"

_PARTICLE = Integer(0, 2**31 - 1)


@dataclass(frozen=True)
class AgentSpec:
    """A robot or person that holds one particle of the object, or several as one rigid piece."""

    name: str
    particle: int = parameter(
        _PARTICLE,
        "The held particle: a rod's segment, held at its centre, or a fabric's vertex.",
        allowed="a particle of the object",
    )
    role: str = parameter(
        Choice(LEADER, ASSISTANT),
        "The leader follows its path. Assistants keep their place relative to it.",
    )
    further_particles: Tuple[int, ...] = parameter(
        Items(_PARTICLE),
        "Vertices of a fabric that the grip holds besides `particle`, such as a clamp bar or a "
        "hand does ([Grips of several vertices](#grips-of-several-vertices)).",
        default=(),
        default_text="none",
        allowed="vertices that nobody holds yet",
    )
    hold: str = parameter(
        Choice("clamped", PINNED),
        "`clamped` keeps the particle's orientation, `pinned` leaves it free. There is no "
        "difference for single vertices of fabrics, which are points.",
        default="clamped",
        allowed="`clamped` with `further_particles`",
    )
    grip_length: Optional[float] = parameter(
        GRIP_LENGTH,
        "Length of a rope or rod that the gripper keeps straight: its width, or 0 for a point. The "
        "segments next to it are then shorter, the others longer. `auto`: the held segment, as "
        "long as all. See [real_objects.md](real_objects.md#what-a-clamp-holds).",
        default=None,
        default_text="`auto`",
        allowed="of clamped agents; grips must not overlap",
    )
    driven_by: str = parameter(
        Choice("command", "pose"),
        "What moves the agent in the simulator. `command`: its velocity command. `pose`: the poses "
        "that a real robot or another simulator publishes.",
        default="command",
    )
    start: Vector = parameter(
        position(),
        "Held point at the start. An assistant keeps its place relative to the leader's. By "
        "default the object is undeformed, with a free length between two agents. It is then taut, "
        "which is beyond the limit of 99 % (`controller.overstretch`): move the starts closer "
        "together.",
        default=(0.0, 0.0, 0.0),
        default_text="the particle on the undeformed object",
        allowed="within the limits of each pair, see controller",
    )
    orientation: Quaternion = parameter(
        UnitQuaternion(),
        "Orientation of the held particle. A clamped particle keeps it. Further particles lie "
        "around it as on the undeformed object, turned by it.",
        default=(0.0, 0.0, 0.0, 1.0),
        default_text="that of the particle on the undeformed object: `object.pose.orientation`, "
        "unless it has a `natural_shape`",
    )

    @property
    def particles(self) -> Tuple[int, ...]:
        """All particles that it holds, that at the held point first."""
        return (self.particle, *self.further_particles)


# start and orientation follow from the object where they are left out.
AGENT = Section(AgentSpec, defaults={"start": None, "orientation": None})


def read_agents(node: Node, spec) -> Tuple[Tuple[AgentSpec, ...], ObjectSpec]:
    """Read and check the ``agents`` section; with it, the object as the agents hold it.

    Args:
        spec: the object, or None if it could not be read; then what depends on it is not
            checked and Unreadable is raised.
    """
    if not isinstance(node.value, dict) or not node.value:
        node.fail("must be a section with one section per agent, by name")
    drafts = {key_text(name): _read_draft(node, name) for name in node.value}
    _check_roles(node, drafts)
    _check_particles(node, drafts, spec)
    if spec is None:
        raise Unreadable
    spec = held_object(node, drafts, spec)
    agents = read_all(partial(_complete, name, draft, spec) for name, draft in drafts.items())
    return tuple(agents), spec


def _read_draft(node: Node, name) -> Draft:
    agent = node.child(name, node.value[name])
    if not isinstance(name, str) or not _NAME.fullmatch(name):
        agent.report.add(
            agent.path,
            "is not a valid agent name; use letters, digits and _, starting with a letter",
        )
    try:
        return AGENT.read_parts(agent)
    except Unreadable:
        return {}


def _check_roles(node: Node, drafts: Dict[str, Draft]) -> None:
    roles = [draft.get("role") for draft in drafts.values()]
    if None in roles:
        return
    if roles.count(LEADER) != 1:
        leaders = [name for name, draft in drafts.items() if draft["role"] == LEADER]
        node.report.add(
            node.path,
            "must have exactly one agent with role {}; {}".format(
                LEADER, "these have it: {}".format(", ".join(leaders)) if leaders else "none has it"
            ),
        )
    if ASSISTANT not in roles:
        node.report.add(node.path, "must have at least one agent with role {}".format(ASSISTANT))


def _check_particles(node: Node, drafts: Dict[str, Draft], spec) -> None:
    holders: Dict[int, str] = {}
    for name, draft in drafts.items():
        particle = draft.get("particle")
        if particle is None:
            continue
        problem = _particle_problem(particle, holders.get(particle), spec)
        if problem:
            node.report.add(node.path + (name, "particle"), problem, show(particle))
            del draft["particle"]
        holders.setdefault(particle, name)
    for name, draft in drafts.items():
        further = draft.get("further_particles", ())
        problems = [
            *_particle_problems(further, name, holders, spec),
            *_grip_problems(draft, spec),
        ]
        for key, problem in problems:
            node.report.add(node.path + (name, key), problem, show(list(further)))
        if problems:
            del draft["further_particles"]


def _particle_problem(particle: int, holder: Optional[str], spec) -> Optional[str]:
    if spec is not None and particle >= spec.particles:
        return "must be a particle of the object: 0 to {}".format(spec.particles - 1)
    if holder is not None:
        return "is already held by agent {}; give each agent its own particle".format(holder)
    return None


def _particle_problems(
    further: Iterable[int], name: str, holders: Dict[int, str], spec
) -> Iterable[Tuple[str, str]]:
    """Keys and what is wrong with further particles, whose agent is added to the holders."""
    for particle in further:
        holder = holders.get(particle)
        if spec is not None and particle >= spec.particles:
            problem = "has {}, which is no particle of the object: 0 to {}".format(
                particle, spec.particles - 1
            )
            yield "further_particles", problem
        elif holder == name:
            yield "further_particles", "has {} twice, or it is the particle itself".format(particle)
        elif holder is not None:
            problem = "has {}, which is already held by agent {}".format(particle, holder)
            yield "further_particles", problem
        holders.setdefault(particle, name)


def _grip_problems(draft: Draft, spec) -> Iterable[Tuple[str, str]]:
    """Keys and what is wrong with an agent that holds several particles."""
    if not draft.get("further_particles"):
        return
    if spec is not None and not spec.is_surface:
        yield (
            "further_particles",
            "are for fabrics: a clamped segment of a {} keeps its orientation by itself. Leave "
            "them out".format(spec.type),
        )
    if draft.get("hold") == PINNED:
        yield "hold", "must be clamped with further_particles, which the grip turns"


def _complete(name: str, draft: Draft, spec) -> AgentSpec:
    if len(draft) < len(AGENT.fields):
        raise Unreadable
    values = dict(draft)
    if values["start"] is None:
        values["start"] = spec.particle_position(values["particle"])
    if values["orientation"] is None:
        values["orientation"] = spec.particle_orientation(values["particle"])
    return AgentSpec(name=name, **values)
