"""The barrier on the force at the grips."""

from dataclasses import dataclass
from typing import Tuple

from deformable_manipulation.scenario.barriers.kind import BarrierKind
from deformable_manipulation.scenario.barriers.loads import (
    alpha_parameter,
    limit_parameter,
    reserve_parameter,
)


@dataclass(frozen=True)
class GripForceSpec:
    """Parameters of the barrier on the force at the grips."""

    max_force: float = limit_parameter(
        "N", "Greatest force that the object exerts on any agent, its weight included."
    )
    reserve: float = reserve_parameter()
    alpha: Tuple[float, float] = alpha_parameter()


BARRIER = BarrierKind(
    name="grip_force",
    spec=GripForceSpec,
    rank=52,
    meaning="Keeps the force at each agent's grip below what wrist and grip bear. "
    "See [loads](barriers/loads.md).",
    margin="grip force margin",
    missed="the force at a grip is too large",
    default=None,
    unit="N",
    needs_wrenches=True,
)
