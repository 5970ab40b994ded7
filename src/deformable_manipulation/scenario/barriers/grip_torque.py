"""The barrier on the torque at the grips."""

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
class GripTorqueSpec:
    """Parameters of the barrier on the torque at the grips."""

    max_torque: float = limit_parameter(
        "N m", "Greatest torque about a held point that the object exerts on its agent."
    )
    reserve: float = reserve_parameter()
    alpha: Tuple[float, float] = alpha_parameter()


BARRIER = BarrierKind(
    name="grip_torque",
    spec=GripTorqueSpec,
    rank=54,
    meaning="Keeps the torque at each agent's grip below what wrist and grip bear. "
    "See [loads](barriers/loads.md).",
    margin="grip torque margin",
    missed="the torque at a grip is too large",
    default=None,
    check=demand_rod("grip_torque", "the vertices of a fabric exert no torque"),
    unit="N m",
    needs_wrenches=True,
)
