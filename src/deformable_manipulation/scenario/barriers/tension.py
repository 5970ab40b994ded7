"""The barrier on the tension along a rod."""

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
class TensionSpec:
    """Parameters of the tension barrier."""

    max_tension: float = limit_parameter("N", "Greatest tension anywhere in the rope or rod.")
    reserve: float = reserve_parameter()
    alpha: Tuple[float, float] = alpha_parameter()


def _derive(scenario):
    rod = scenario.object
    gravity = scenario.simulation.gravity
    return {
        "weight": [rod.mass / rod.segments * component for component in gravity],
        "particles": [agent.particle for agent in scenario.agents],
    }


BARRIER = BarrierKind(
    name="tension",
    spec=TensionSpec,
    rank=56,
    meaning="Keeps the tension anywhere in a rope or rod below what it bears. "
    "See [loads](barriers/loads.md).",
    margin="tension margin",
    missed="the tension of the object is too large",
    default=None,
    derive=_derive,
    check=demand_rod("tension", "the tension of a fabric is its strain, see controller.strain"),
    unit="N",
    needs_wrenches=True,
)
