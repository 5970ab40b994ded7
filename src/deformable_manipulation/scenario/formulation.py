"""What ``controller.formulation: paper`` says about the other keys of the controller."""

import dataclasses
from typing import Any, Dict

from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.readers import Node, Report, Section
from deformable_manipulation.scenario.spec import DECENTRALISED, ControllerSpec

FULL, PAPER = "full", "paper"

# The paper's values: defaults with ``formulation: paper``, and nothing else is allowed there.
_PAPERS = {
    "cooperation": DECENTRALISED,
    "jacobian": "perturbed_copies",
    "differences": "forward",
    "feedforward": False,
    "smoothing": 0.0,
    "collision": {
        "margin": 0.0,
        "speed_margin": 0.0,
        "obstacle_velocity": False,
        "gradient": "minimum",
    },
    "overstretch": {"margin": 0.0},
    "proximity": {"margin": 0.0},
}


class FormulatedSection(Section):
    """The controller's section, whose defaults depend on its formulation."""

    def read_parts(self, node: Node) -> Dict[str, Any]:
        value = node.value
        if isinstance(value, dict) and value.get("formulation") == PAPER:
            node = dataclasses.replace(node, value=_completed(value, _PAPERS))
        return super().read_parts(node)


def _completed(given, defaults):
    """``given`` with the defaults for what it lacks, at every depth; no mapping: as it is."""
    if not (isinstance(given, dict) and isinstance(defaults, dict)):
        return given
    known = {
        key: _completed(given.get(key, {}), value)
        for key, value in defaults.items()
        if isinstance(value, dict)
    }
    return {**defaults, **given, **known}


def check_formulation(report: Report, controller: ControllerSpec) -> None:
    """The paper's formulation with nothing but the paper's values."""
    if controller.formulation == PAPER:
        _check_values(report, ("controller",), controller, _PAPERS)


def _check_values(report: Report, path, section, wanted) -> None:
    for key, value in wanted.items():
        given = getattr(section, key)
        if isinstance(value, dict):
            _check_values(report, path + (key,), given, value)
        elif given != value:
            report.add(
                path + (key,),
                "must be {} with controller.formulation: paper; leave it out, or take formulation: "
                "full".format(show(value)),
                show(given),
            )
