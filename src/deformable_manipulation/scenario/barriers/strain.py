"""The barrier on the strain of edges."""

from dataclasses import dataclass
from typing import Tuple

import numpy as np

from deformable_manipulation.scenario.barriers.kind import BarrierKind
from deformable_manipulation.scenario.barriers.loads import (
    alpha_parameter,
    limit_parameter,
    reserve_parameter,
)


@dataclass(frozen=True)
class StrainSpec:
    """Parameters of the strain barrier."""

    max_strain: float = limit_parameter(
        "1",
        "Greatest elongation of an edge over its unstretched length: of a side of a triangle, or "
        "of a segment.",
    )
    reserve: float = reserve_parameter()
    alpha: Tuple[float, float] = alpha_parameter()


def _derive(scenario):
    ends, lengths = scenario.object.edges()
    return {"edges": np.column_stack((ends, lengths))}


BARRIER = BarrierKind(
    name="strain",
    spec=StrainSpec,
    rank=58,
    meaning="Keeps each edge of a fabric's mesh, or segment of an extensible rod, from being "
    "stretched too far. "
    "See [loads](barriers/loads.md).",
    margin="strain margin",
    missed="the object is strained too far",
    default=None,
    derive=_derive,
    unit="1",
)
