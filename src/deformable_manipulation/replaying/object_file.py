"""The object of a recording: the section ``object`` of a YAML file, and how it is simulated."""

from dataclasses import dataclass
from typing import Iterable, Optional, Sequence

from deformable_manipulation.objects.body import GRAVITY, JOINT_SOLVER
from deformable_manipulation.objects.kinds import read_object
from deformable_manipulation.objects.spec import ObjectSpec
from deformable_manipulation.reading.document import read_document
from deformable_manipulation.reading.errors import ScenarioError
from deformable_manipulation.reading.overrides import Override, apply_overrides
from deformable_manipulation.reading.readers import Node, Report, Unreadable
from deformable_manipulation.scenario.files import find_scenario
from deformable_manipulation.scenario.simulation import SIMULATION, for_object

_UNUSED = {"duration": 1.0}  # demanded of a scenario, not needed here


@dataclass(frozen=True)
class MeasuredObject:
    """An object, and its simulation where the file has a section ``simulation``."""

    spec: ObjectSpec
    gravity: Sequence[float] = GRAVITY
    solver: str = JOINT_SOLVER
    substeps: Optional[int] = None


def load_object(path_or_name: str, overrides: Iterable[Override] = ()) -> MeasuredObject:
    """Read a file that has a section ``object``, such as a scenario; other sections do not matter.

    Args:
        path_or_name: a YAML file, or the name of a scenario of this package.
        overrides: (key path, value as YAML text) pairs, as ``("object.damping", "0")``.

    Raises:
        ScenarioError: with all problems found.
    """
    overrides = tuple(overrides)
    path = find_scenario(path_or_name)
    document = read_document(path)
    raw, lines, problems = apply_overrides(document.value, document.lines, overrides)
    report = Report(lines, [tuple(key.split(".")) for key, _ in overrides])
    report.problems.extend(document.problems)
    report.problems.extend(problems)
    if not isinstance(raw, dict) or "object" not in raw:
        report.add(("object",), "is missing: the file needs a section object, as in a scenario")
        raise ScenarioError(report.problems, str(path))
    root = Node(raw, (), report, path.resolve().parent)
    found = None
    try:
        found = _read(root, raw)
    except Unreadable:
        pass
    if report.problems or found is None:
        raise ScenarioError(report.problems, str(path))
    return found


def _read(root: Node, raw: dict) -> MeasuredObject:
    spec = read_object(root.child("object", raw["object"]))
    if "simulation" not in raw:
        return MeasuredObject(spec)
    section = raw["simulation"]
    if isinstance(section, dict):
        section = {**_UNUSED, **section}
    given = SIMULATION(root.child("simulation", section))
    filled = for_object(root.report, given, spec)
    return MeasuredObject(spec, filled.gravity, filled.solver, given.substeps)
