"""The barrier that keeps two agents apart (paper, eqs. 11 and 12)."""

from dataclasses import dataclass
from typing import Optional, Tuple

from deformable_manipulation.reading.parameter import Live, parameter
from deformable_manipulation.reading.readers import Auto, Slopes
from deformable_manipulation.scenario.barriers.kind import BarrierKind, margin_parameter
from deformable_manipulation.scenario.barriers.pairs import limit_matrix


@dataclass(frozen=True)
class ProximitySpec:
    """Parameters of the proximity barrier."""

    min_distance: Optional[float] = parameter(
        Auto("m", at_least=0.0),
        "Least distance between two held points. `auto`: 10 % of the free length between their "
        "particles. Raise it to the size of your grippers.",
        default=None,
        allowed="below the maximum distance of every pair",
        live=Live(("min_distance",), -1.0, 100.0),
    )
    margin: float = margin_parameter(
        "The rows stay this much beyond the limit.",
        default=0.0,
        live=Live(("proximity_margin",), 0.0, 0.5),
    )
    alpha: Tuple[float, float] = parameter(
        Slopes(),
        "How fast h may shrink, per metre left, and how fast a violation is corrected.",
        default=(1.0, 2.0),
        live=Live(("proximity_alpha", "proximity_alpha_back"), 0.01, 50.0),
        native=True,
    )


def _derive(scenario):
    limits = limit_matrix(scenario.object, scenario.agents, scenario.controller, "min_distance")
    return {"limits": limits}


BARRIER = BarrierKind(
    name="proximity",
    spec=ProximitySpec,
    rank=40,
    meaning="Keeps the agents apart.",
    margin="proximity margin",
    missed="agents are too near each other",
    default=ProximitySpec(),
    derive=_derive,
)
