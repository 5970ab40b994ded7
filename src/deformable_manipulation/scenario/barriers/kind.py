"""What is declared of a barrier."""

import dataclasses
from dataclasses import dataclass
from typing import Any, Callable, Dict, Optional, Tuple

from deformable_manipulation.reading.parameter import declared_below, parameter
from deformable_manipulation.reading.readers import LARGEST_COORDINATE, Number, Section


def _nothing(*_arguments) -> Dict[str, Any]:
    return {}


def _no_check(*_arguments) -> None:
    return None


@dataclass(frozen=True)
class BarrierKind:
    """A barrier: its section of ``controller``, and how others speak of it.

    Attributes:
        name: key of its section, name in the C++ core, and end of the columns ``h_NAME`` and
            ``slack_NAME``.
        spec: dataclass of its parameters.
        rank: its place among the barriers and in the default priority; the lowest yields last.
        meaning: of the section, for docs/parameters.md.
        margin: what h is, in words, for plots and summaries: "overstretch margin".
        missed: what is the case where h is negative, as a clause: "the object is overstretched".
        default: its section where the scenario has none: None leaves the barrier out; ``NOTHING``
            of :mod:`~..parameter` demands the section.
        derive: what the C++ core needs beyond the parameters: called with the scenario; gives a
            mapping of plain values.
        of_object: keys whose defaults the object has, as attributes ``NAME_KEY``.
        check: called with a Report, the object, the agents and the controller; reports what does
            not go together.
        unit: of h; "m", or that of what the object bears: h is then a limit minus a load.
        needs_wrenches: whether h depends on what the object exerts on the agents.
    """

    name: str
    spec: type
    rank: int
    meaning: str
    margin: str
    missed: str
    default: Any
    derive: Callable[..., Dict[str, Any]] = _nothing
    check: Callable[..., None] = _no_check
    of_object: Tuple[str, ...] = ()
    unit: str = "m"
    needs_wrenches: bool = False

    @property
    def is_load(self) -> bool:
        """Whether h is about what the object bears, and not a length."""
        return self.unit != "m"

    def show(self, h: Optional[float], digits: int = 1) -> str:
        """An h with its unit, lengths in mm; ``none`` of None.

        Args:
            digits: behind the point, of lengths.
        """
        if h is None:
            return "none"
        if self.is_load:
            return f"{h:.3g}" if self.unit == "1" else f"{h:.3g} {self.unit}"
        return f"{1e3 * h:.{digits}f} mm"

    def __post_init__(self):
        if self.default is not None:
            return
        for path, declaration in declared_below(self.spec):
            if declaration.live is not None:
                raise ValueError(
                    "barrier {}: {} must not be live, as the section may be missing "
                    "(default=None); leave live out, or give the section a default".format(
                        self.name, ".".join(path)
                    )
                )

    def for_object(self, section: Any, spec) -> Any:
        """The section with what depends on the object filled in where it was left out."""
        missing = [key for key in self.of_object if getattr(section, key) is None]
        return dataclasses.replace(
            section, **{key: getattr(spec, f"{self.name}_{key}") for key in missing}
        )

    def field(self):
        """The parameter of the section ``controller`` that holds this barrier's section."""
        return parameter(
            Section(self.spec, defaults=dict.fromkeys(self.of_object)),
            self.meaning,
            default=self.default,
            default_text="none" if self.default is None else "all defaults",
            native=True,
        )


def margin_parameter(meaning: str, default: float, live, default_text: str = ""):
    """The parameter ``margin`` that most barriers have: how far the rows stay within the limit."""
    reader = Number("m", at_least=0.0, at_most=LARGEST_COORDINATE)
    return parameter(
        reader,
        meaning,
        default=default,
        default_text=default_text,
        paper=0.0,
        live=live,
        native=True,
    )
