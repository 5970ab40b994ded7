"""The tables of docs/parameters.md, made of the declarations.

A table stands below the heading of its section, between two comments; what is around it is written
by hand. The barriers' sections stand in one place, headings and all.
"""

import re
import sys
from typing import Any, Dict, Iterable, List, Sequence, Tuple

from deformable_manipulation.objects.grip import GRIP
from deformable_manipulation.objects.kinds import KINDS
from deformable_manipulation.objects.natural_shape import NATURAL_SHAPE
from deformable_manipulation.objects.point_mass import POINT_MASS
from deformable_manipulation.obstacles.kinds import COMMON_KEYS
from deformable_manipulation.obstacles.kinds import KINDS as OBSTACLE_KINDS
from deformable_manipulation.obstacles.leave_out import LEAVE_OUT, OWN_SHAPE
from deformable_manipulation.obstacles.motions import MOTION, POSE_WAYPOINT
from deformable_manipulation.reading.parameter import Parameter
from deformable_manipulation.reading.pose import POSE
from deformable_manipulation.reading.readers import Items, Section
from deformable_manipulation.scenario.agents import AGENT
from deformable_manipulation.scenario.barriers import BARRIERS
from deformable_manipulation.scenario.camera import CAMERA
from deformable_manipulation.scenario.correction import CORRECTION
from deformable_manipulation.scenario.formulation import CONTROLLER
from deformable_manipulation.scenario.horizon import HORIZON
from deformable_manipulation.scenario.knowledge import KNOWLEDGE
from deformable_manipulation.scenario.loader import SCENARIO
from deformable_manipulation.scenario.simulation import SIMULATION
from deformable_manipulation.scenario.waypoints import LEADER_PATH, WAYPOINT, WORKSPACE
from deformable_manipulation.scenario.wrench_watch import WRENCH_WATCH
from deformable_manipulation.system.package_files import package_share_directory

HEADER = "| key | type | unit | default | allowed | live | meaning; when to change it |"
_RULE = "|---|---|---|---|---|---|---|"
_BEGIN = "<!-- made by scripts/parameters_page -->"
_END = "<!-- end -->"
_BEGIN_BARRIERS = "<!-- barriers: made by scripts/parameters_page -->"
_BARRIERS = re.compile(
    re.escape(_BEGIN_BARRIERS) + r"\n.*?" + re.escape(_END), re.MULTILINE | re.DOTALL
)
_TABLE = re.compile(
    r"^(?P<heading>#+ (?P<name>[^\n]+)\n(?:(?!#)[^\n]*\n)*?)"
    + re.escape(_BEGIN)
    + r"\n.*?"
    + re.escape(_END),
    re.MULTILINE | re.DOTALL,
)


class _Excerpt:
    """Some keys of a section, where the others stand elsewhere."""

    def __init__(self, section: Section, keys: Iterable[str]):
        self.spec, self.others, self.spec_default = section.spec, {}, section.spec_default
        self.declarations = {key: each for key, each in section.declarations.items() if key in keys}


def _own_section(kind: str) -> Any:
    """The keys that a kind of obstacle has for itself: those of its section, if that is all."""
    section = OBSTACLE_KINDS[kind].section
    own = [key for key in section.fields if key not in COMMON_KEYS]
    below = section.fields[kind]
    return below if own == [kind] and isinstance(below, Section) else _Excerpt(section, own)


def sections() -> Dict[str, Any]:
    """Every section with a heading of its own, by that heading."""
    return {
        "Top level": SCENARIO,
        **{"object: " + name: kind.section for name, kind in KINDS.items()},
        "object.natural_shape": NATURAL_SHAPE,
        "object.point_masses": POINT_MASS,
        "object.grips": GRIP,
        "object.pose": POSE,
        "agents": AGENT,
        "obstacles": _Excerpt(OBSTACLE_KINDS["polygon"].section, COMMON_KEYS),
        **{"obstacles: " + name: _own_section(name) for name in OBSTACLE_KINDS},
        "obstacles: leave_out": LEAVE_OUT,
        "obstacles: leave_out.shapes": OWN_SHAPE,
        "obstacles: motion": MOTION,
        "obstacles: motion.waypoints": POSE_WAYPOINT,
        "leader": LEADER_PATH,
        "leader.waypoints": WAYPOINT,
        "leader.workspace": WORKSPACE,
        "controller": CONTROLLER,
        "controller.horizon": HORIZON,
        "controller.wrench_watch": WRENCH_WATCH,
        "simulation": SIMULATION,
        "correction": CORRECTION,
        "knowledge": KNOWLEDGE,
        "camera": CAMERA,
    }


def updated(page: str) -> str:
    """The page with its tables as the declarations are now.

    Raises:
        ValueError: a section has no place for its table, or a table is of no section.
    """
    wanted = sections()
    places = [match["name"].strip() for match in _TABLE.finditer(page)]
    problems = [
        "no table below the heading '{}': write the heading and, below it, the two lines {} and "
        "{}".format(name, _BEGIN, _END)
        for name in wanted
        if name not in places
    ]
    problems += [
        "a table below '{}', which is no section".format(n) for n in places if n not in wanted
    ]
    if len(_BARRIERS.findall(page)) != 1:
        problems.append("no place for the barriers' sections")
    if problems:
        raise ValueError("docs/parameters.md has {}".format("; ".join(problems)))

    def replaced(match: "re.Match[str]") -> str:
        lines = [_BEGIN, *_table(wanted[match["name"].strip()]), _END]
        return match["heading"] + "\n".join(lines)

    return _BARRIERS.sub(lambda _: _barriers(), _TABLE.sub(replaced, page))


def _barriers() -> str:
    """Heading, meaning and tables of each barrier's section."""
    lines = [_BEGIN_BARRIERS]
    for name, kind in BARRIERS.items():
        section = Section(kind.spec)
        lines += ["### controller.{}".format(name), "", kind.meaning, "", *_table(section), ""]
        for key, reader in section.fields.items():
            if isinstance(reader, Items):
                heading = "#### controller.{}: {}".format(name, key)
                lines += [heading, "", *_table(reader.item), ""]
    return "\n".join([*lines, _END])


def _table(section) -> List[str]:
    return [HEADER, _RULE, *(_row(*row) for row in _rows(section))]


def _rows(section) -> List[Tuple[str, Parameter, Any]]:
    """Key, declaration and default of each parameter."""
    others = [(key, each, Section.REQUIRED) for key, each in section.others.items()]
    return others + [
        (key, declaration, section.spec_default(attribute))
        for key, (attribute, declaration) in section.declarations.items()
    ]


def _row(key: str, declaration: Parameter, default: Any) -> str:
    reader = declaration.reader
    cells = [
        "`{}`".format(key),
        reader.type,
        reader.unit,
        declaration.default_text or _shown(default),
        _allowed(declaration),
        ", ".join("`{}`".format(name) for name in declaration.live.names)
        if declaration.live
        else "",
        declaration.meaning,
    ]
    return "| {} |".format(" | ".join(cells)).replace("|  |", "| |").replace("|  |", "| |")


def _allowed(declaration: Parameter) -> str:
    parts = [declaration.reader.range, declaration.allowed]
    return "; ".join(part.replace("|", "\\|") for part in parts if part)


def _shown(default: Any) -> str:
    if default is Section.REQUIRED:
        return ""
    if default is None:
        return "`auto`"
    if isinstance(default, bool):
        return "`true`" if default else "`false`"
    if isinstance(default, tuple):
        return "`[{}]`".format(", ".join(map(_number, default)))
    return "`{}`".format(default if isinstance(default, str) else _number(default))


def _number(value: float) -> str:
    return "{:g}".format(value) if abs(value) >= 1e5 else repr(value)


def main(arguments: Sequence[str]) -> int:
    """Write the page of this checkout, or check it; returns the exit status."""
    path = package_share_directory() / "docs" / "parameters.md"
    page = path.read_text(encoding="utf-8")
    try:
        fresh = updated(page)
    except ValueError as error:
        print("parameters_page: {}".format(error), file=sys.stderr)
        return 1
    if list(arguments) == ["--check"]:
        if fresh != page:
            print("docs/parameters.md is out of date: run scripts/parameters_page", file=sys.stderr)
        return int(fresh != page)
    path.write_text(fresh, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
