"""The barrier that keeps a rod from being bent too sharply."""

from dataclasses import dataclass
from typing import Tuple

from deformable_manipulation.scenario.barriers.kind import BarrierKind
from deformable_manipulation.scenario.barriers.loads import (
    alpha_parameter,
    demand_rod,
    limit_parameter,
    reserve_parameter,
)


@dataclass(frozen=True)
class BendingSpec:
    """Parameters of the bending barrier."""

    min_radius: float = limit_parameter("m", "Least bend radius of the centre line, anywhere.")
    reserve: float = reserve_parameter()
    alpha: Tuple[float, float] = alpha_parameter()


def _derive(scenario):
    return {"segment_length": scenario.object.length / scenario.object.segments}


BARRIER = BarrierKind(
    name="bending",
    spec=BendingSpec,
    rank=50,
    meaning="Keeps a rope or rod from being bent too sharply anywhere. "
    "See [loads](barriers/loads.md).",
    margin="bending margin",
    missed="the object is bent too sharply",
    default=None,
    derive=_derive,
    check=demand_rod("bending", "a fabric folds, and has no bend radius"),
    unit="1/m",
)
