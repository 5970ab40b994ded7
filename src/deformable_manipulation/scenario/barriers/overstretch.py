"""The barrier that keeps two agents from overstretching the object (paper, eqs. 8 to 10)."""

from dataclasses import dataclass
from typing import Optional, Tuple

from deformable_manipulation.reading.parameter import Live, parameter
from deformable_manipulation.reading.readers import Auto, Number, Slopes
from deformable_manipulation.scenario.barriers.kind import BarrierKind, margin_parameter
from deformable_manipulation.scenario.barriers.pairs import limit_matrix


@dataclass(frozen=True)
class OverstretchSpec:
    """Parameters of the overstretch barrier."""

    max_distance: Optional[float] = parameter(
        Auto("m", above=0.0),
        "Greatest distance between two held points. `auto`: `fraction` of the free length between "
        "their particles.",
        default=None,
        allowed="at most the free length of every pair",
        live=Live(("max_distance",), -1.0, 100.0),
    )
    fraction: float = parameter(
        Number("1", above=0.0, at_most=1.0),
        "Of the free length, for `auto`. Lower it to keep some slack.",
        default=0.99,
        live=Live(("max_fraction",), 0.01, 1.0),
    )
    margin: float = margin_parameter(
        "The rows stay this much within the limit.",
        default=0.005,
        live=Live(("overstretch_margin",), 0.0, 0.5),
    )
    alpha: Tuple[float, float] = parameter(
        Slopes(),
        "How fast h may shrink, per metre left, and how fast a violation is corrected.",
        default=(1.0, 2.0),
        live=Live(("overstretch_alpha", "overstretch_alpha_back"), 0.01, 50.0),
        native=True,
    )


def _derive(scenario):
    limits = limit_matrix(scenario.object, scenario.agents, scenario.controller, "max_distance")
    return {"limits": limits}


BARRIER = BarrierKind(
    name="overstretch",
    spec=OverstretchSpec,
    rank=30,
    meaning="Keeps the agents from overstretching the object.",
    margin="overstretch margin",
    missed="the object is overstretched",
    default=OverstretchSpec(),
    derive=_derive,
)
