"""Lengths of the agents' grips, and the object as these divide it into segments."""

from typing import Any, Dict

from deformable_manipulation.objects.rod import RodSpec
from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.readers import Node

Draft = Dict[str, Any]  # attributes of an AgentSpec that could be read


def held_object(node: Node, drafts: Dict[str, Draft], spec):
    """The object as agents hold it; as it is where it cannot be held so, which is reported.

    Args:
        node: of the section ``agents``.
        drafts: by the agents' names.
        spec: the object.
    """
    good = all([_check_length(node, name, draft, spec) for name, draft in drafts.items()])
    known = {
        name: draft
        for name, draft in drafts.items()
        if "particle" in draft and "grip_length" in draft
    }
    if not good or len(known) < len(drafts):
        return spec
    held = spec.held_by([(draft["particle"], draft["grip_length"]) for draft in known.values()])
    if isinstance(spec, RodSpec) and spec.grips not in ((), held.grips):
        node.report.add(
            ("object", "grips"),
            "follows from the agents' grip_length: leave it out, and give agents their grip_length",
        )
        return spec
    problem = held.division_problem() if isinstance(held, RodSpec) else None
    if problem is None:
        return held
    node.report.add(node.path, "{}: {}".format(_tightest(known, held), problem))
    return spec


def _check_length(node: Node, name: str, draft: Draft, spec) -> bool:
    """Report a grip's length that this agent cannot have; returns whether it can."""
    length = draft.get("grip_length")
    if length is None:
        return True
    problem = None
    if not isinstance(spec, RodSpec):
        problem = "is for ropes and rods: leave it out, a fabric's particles are points"
    elif draft.get("hold") == "pinned":
        problem = (
            "must be left out of a pinned agent, which holds the rod at a point and lets it turn; "
            "or hold it clamped"
        )
    elif length >= spec.length:
        problem = "must be less than object.length ({:g} m)".format(spec.length)
    if problem is not None:
        node.report.add(node.path + (name, "grip_length"), problem, show(length))
    return problem is None


def _tightest(drafts: Dict[str, Draft], rod: RodSpec) -> str:
    """The two grips, or the grip and the end of the rod, that have least room between them."""
    usual = rod.length / rod.segments
    last = rod.segments - 1
    begins, ends, names = [], [], []
    ordered = sorted(drafts.items(), key=lambda item: item[1]["particle"])
    for name, draft in ordered:
        half = 0.5 * (usual if draft["grip_length"] is None else draft["grip_length"])
        centre = (draft["particle"] + 0.5) * usual
        begins.append(0.0 if draft["particle"] == 0 else centre - half)
        ends.append(rod.length if draft["particle"] == last else centre + half)
        names.append(name)
    rooms = [
        (begin - end, "the grips of {} and {}".format(*pair))
        for end, begin, pair in zip(ends, begins[1:], zip(names, names[1:]))
    ]
    if ordered[0][1]["particle"] > 0:
        rooms.append((begins[0], "the first end and the grip of {}".format(names[0])))
    if ordered[-1][1]["particle"] < last:
        rooms.append((rod.length - ends[-1], "the grip of {} and the last end".format(names[-1])))
    return "must leave more of the rod between {}".format(min(rooms)[1])
