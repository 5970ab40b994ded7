"""What ``controller.formulation: paper`` says about the other keys of the controller."""

import dataclasses
from typing import Any, Dict

from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.parameter import ANY, declared_below
from deformable_manipulation.reading.readers import Node, Report, Section
from deformable_manipulation.scenario.controller import PAPER, ControllerSpec
from deformable_manipulation.scenario.horizon import HORIZON_OF_OBJECT

# The paper's values, by key path: defaults with ``formulation: paper``, and no others are allowed.
PAPERS = {
    path: declaration.paper
    for path, declaration in declared_below(ControllerSpec)
    if declaration.paper is not ANY
}


class FormulatedSection(Section):
    """The controller's section, whose defaults depend on its formulation."""

    def read_parts(self, node: Node) -> Dict[str, Any]:
        """See :meth:`~.readers.Section.read_parts`."""
        if isinstance(node.value, dict) and node.value.get("formulation") == PAPER:
            node = dataclasses.replace(node, value=_completed(node.value))
        return super().read_parts(node)


# These depend on the object where they are left out: controller.for_object() fills them in.
_OF_OBJECT = {
    **dict.fromkeys(("jacobian", "disturbance_filter")),
    "horizon": HORIZON_OF_OBJECT,
}
CONTROLLER = FormulatedSection(ControllerSpec, defaults=_OF_OBJECT)


def _completed(given: Dict[str, Any]) -> Dict[str, Any]:
    """``given`` with the paper's values for what it lacks; what is no section stays as it is."""
    completed = dict(given)
    for path, value in PAPERS.items():
        section = completed
        for key in path[:-1]:
            if key not in section and not _is_in_use(key):
                break
            below = section.get(key, {})
            if not isinstance(below, dict):
                break
            section[key] = dict(below)
            section = section[key]
        else:
            section.setdefault(path[-1], value)
    return completed


def _is_in_use(key: str) -> bool:
    """Whether a section is there where the scenario does not give it."""
    return CONTROLLER.defaults.get(key) is not None or key not in CONTROLLER.defaults


def check_formulation(report: Report, controller: ControllerSpec) -> None:
    """The paper's formulation with nothing but the paper's values."""
    if controller.formulation != PAPER:
        return
    for path, wanted in PAPERS.items():
        given: Any = controller
        for key in path:
            given = getattr(given, key, None)
            if given is None:
                break
        if given is not None and given != wanted:
            report.add(
                ("controller", *path),
                "must be {} with controller.formulation: paper; leave it out, or use formulation: "
                "full".format(show(wanted)),
                show(given),
            )
