"""Declaration of parameters: all there is to know of a key of the scenario, in one place.

A section of the scenario is a frozen dataclass whose fields are made by :func:`parameter`. These
declarations give the reader with its messages (:class:`~.readers.Section`), the way back to YAML
(``scenario.mapping``), what ``formulation: paper`` demands (``scenario.formulation``), the
parameters that can change while running (``config/*.cfg``, ``ros.live_parameters``), the tables of
docs/parameters.md (``scenario.parameters_page``) and what goes to the C++ core
(``control.parameters``).
"""

import dataclasses
from dataclasses import dataclass
from typing import Any, Dict, Iterator, Optional, Tuple

ANY = object()  # the paper's formulation leaves the value free
NOTHING = object()
CONTROLLER, SIMULATOR = "controller", "simulator"  # nodes that have live parameters


@dataclass(frozen=True)
class Live:
    """How a parameter is changed while running, by dynamic_reconfigure.

    Attributes:
        names: of the number, or of each component of a list.
        least: lower end of the slider.
        most: upper end of the slider.
        node: which node has it: CONTROLLER or SIMULATOR.
    """

    names: Tuple[str, ...]
    least: float
    most: float
    node: str = CONTROLLER


@dataclass(frozen=True)
class Parameter:
    """What is declared of a key beside its name, its type hint and its default.

    Attributes:
        reader: makes the value of a node of the file; knows type, unit and range.
        meaning: what it does and when to change it, in Markdown.
        default_text: the default in words, where it depends on something else; empty: the default.
        allowed: what else is demanded, in words, such as relations to other keys.
        paper: the only value that ``formulation: paper`` takes, and its default there; or ANY.
        live: how it is changed while running; None: it stays as it is.
        native: whether the C++ core reads it by this name.
        key: its name in the file, where the attribute has another; empty: the same.
    """

    reader: Any
    meaning: str
    default_text: str = ""
    allowed: str = ""
    paper: Any = ANY
    live: Optional[Live] = None
    native: bool = False
    key: str = ""


def parameter(reader, meaning: str, default: Any = NOTHING, **details) -> Any:
    """A field of a dataclass that declares a parameter.

    Args:
        reader: see :class:`Parameter`, like the other arguments.
        meaning: in Markdown.
        default: of a key that may be absent; left out: the key must be there.
        **details: the other attributes of :class:`Parameter`.
    """
    metadata = {"parameter": Parameter(reader, meaning, **details)}
    if default is NOTHING:
        return dataclasses.field(metadata=metadata)
    return dataclasses.field(default=default, metadata=metadata)


def declared(spec) -> Dict[str, Tuple[str, Parameter]]:
    """The parameters of a section: key -> (attribute, declaration), in their order.

    Args:
        spec: a dataclass, or an instance of one.
    """
    parameters = {}
    for field in dataclasses.fields(spec):
        declaration = field.metadata.get("parameter")
        if declaration is not None:
            parameters[declaration.key or field.name] = (field.name, declaration)
    return parameters


def declared_below(spec, path: Tuple[str, ...] = ()) -> Iterator[Tuple[Tuple[str, ...], Parameter]]:
    """All parameters of a section and of the sections in it, with their key paths."""
    for key, (_, declaration) in declared(spec).items():
        yield (*path, key), declaration
        below = getattr(declaration.reader, "spec", None)
        if below is not None:
            yield from declared_below(below, (*path, key))
