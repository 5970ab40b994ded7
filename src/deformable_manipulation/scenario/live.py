"""Parameters that can change while nodes run, for dynamic_reconfigure's files in ``config/``."""

import re
from typing import Any, Dict, List, Tuple

from deformable_manipulation.reading.parameter import CONTROLLER, Parameter, declared_below
from deformable_manipulation.scenario.controller import ControllerSpec

_COMPONENTS = {3: ("along x", "along y", "along z"), 2: ("for h >= 0", "for h < 0")}
Live = Tuple[Tuple[str, ...], Parameter]


def live_parameters(node: str = CONTROLLER) -> List[Live]:
    """The live parameters of a node, with their key paths in the section ``controller``."""
    return [
        (path, declaration)
        for path, declaration in declared_below(ControllerSpec)
        if declaration.live is not None and declaration.live.node == node
    ]


def add_parameters(generator, number_type: str, node: str) -> None:
    """Add a node's live parameters to the generator of its dynamic_reconfigure file.

    Args:
        generator: dynamic_reconfigure's ``ParameterGenerator``; each section gets a group.
        number_type: its ``double_t``.
        node: whose parameters, see :class:`~deformable_manipulation.reading.parameter.Live`.
    """
    groups: Dict[Tuple[str, ...], Any] = {(): generator}
    for path, declaration in live_parameters(node):
        section, live = path[:-1], declaration.live
        assert live is not None
        if section not in groups:
            groups[section] = generator.add_group("_".join(section))
        for index, name in enumerate(live.names):
            text = _description(declaration, index)
            # The node fills in the scenario's values; the default here is never used.
            groups[section].add(name, number_type, 1, text, live.least, live.least, live.most)


def _description(declaration: Parameter, index: int) -> str:
    """A parameter, or one component of it, in a line."""
    text = "[{}] {}".format(declaration.reader.unit, _first_sentence(declaration.meaning))
    count = len(declaration.live.names) if declaration.live else 1
    if count > 1:
        text += ", " + _COMPONENTS[count][index]
    if declaration.reader.type.endswith("`auto`"):
        text += "; -1: auto"
    return text


def _first_sentence(markdown: str) -> str:
    text = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", markdown).replace("`", "")
    return text.partition(". ")[0].rstrip(".")
