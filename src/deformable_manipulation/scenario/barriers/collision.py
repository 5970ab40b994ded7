"""The barrier that keeps the object off the obstacles (paper, eqs. 3 to 7)."""

from dataclasses import dataclass
from typing import Tuple

from deformable_manipulation.reading.parameter import NOTHING, Live, parameter
from deformable_manipulation.reading.readers import (
    LARGEST_COORDINATE,
    Choice,
    Flag,
    Number,
    Slopes,
)
from deformable_manipulation.scenario.barriers.kind import BarrierKind, margin_parameter


@dataclass(frozen=True)
class CollisionSpec:
    """Parameters of the collision barrier."""

    offset: float = parameter(
        Number("m", at_least=0.0, at_most=LARGEST_COORDINATE),
        "Distance to keep, from surface to surface: h = distance - offset.",
        live=Live(("collision_offset",), 0.0, 1.0),
        native=True,
    )
    alpha: Tuple[float, float] = parameter(
        Slopes(),
        "How fast h may shrink, per metre left, and how fast a violation is corrected. "
        "Lower the first to slow down farther from obstacles.",
        default=(1.0, 5.0),
        live=Live(("collision_alpha", "collision_alpha_back"), 0.01, 50.0),
        native=True,
    )
    anticipation: Tuple[float, float] = parameter(
        Slopes(),
        "Slopes of a second, soft row beside each. Lower the first to make way earlier; "
        "the same slopes as `alpha` switch it off.",
        default=(0.4, 5.0),
        live=Live(("anticipation", "anticipation_back"), 0.01, 50.0),
        native=True,
    )
    margin: float = margin_parameter(
        "The rows keep this much more than `offset`. "
        "Raise it for noisy poses or an uncertain object.",
        default=0.002,
        default_text="`0.002`; for fabrics `0.01`",
        live=Live(("collision_margin",), 0.0, 0.2),
    )
    speed_margin: float = parameter(
        Number("s", at_least=0.0, at_most=10.0),
        "And this much more per m/s of the leader's speed. "
        "Raise it where the leader turns without warning.",
        default=0.0,
        default_text="`0`; for fabrics `0.2`",
        paper=0.0,
        live=Live(("collision_speed_margin",), 0.0, 10.0),
        native=True,
    )
    snap_margin: float = parameter(
        Number("m", at_least=0.0, at_most=LARGEST_COORDINATE),
        "And up to this much more where the perturbed copies part from one another, as when a "
        "fold is about to snap. Raise it for limp fabrics.",
        default=0.0,
        default_text="`0`; for fabrics `0.01`",
        paper=0.0,
        live=Live(("collision_snap_margin",), 0.0, 0.2),
        native=True,
    )
    band: float = parameter(
        Number("m", at_least=0.0, at_most=LARGEST_COORDINATE),
        "Features up to this much farther than the nearest get a row of their own in the QP. "
        "Raise it where the object lies along an obstacle.",
        default=0.1,
        native=True,
    )
    obstacle_velocity: bool = parameter(
        Flag(),
        "Whether the rows use the velocity of [moving obstacles](#obstacles-motion).",
        default=True,
        paper=False,
        native=True,
    )
    gradient: str = parameter(
        Choice("features", "minimum"),
        "`features`: a row for each near feature. `minimum`: the paper's single row for the "
        "lowest distance.",
        default="features",
        paper="minimum",
        native=True,
    )
    backend: str = parameter(
        Choice("native", "reference"),
        "What computes the distances: the C++ core, or Trimesh, FCL and Shapely for comparison. "
        "These are many times slower, and exact for depths only to an eighth of a segment or "
        "triangle.",
        default="native",
    )


BARRIER = BarrierKind(
    name="collision",
    spec=CollisionSpec,
    rank=10,
    meaning="Keeps the object off the obstacles.",
    margin="distance minus offset",
    missed="the object is too near an obstacle",
    default=NOTHING,
    of_object=("margin", "speed_margin", "snap_margin"),
)
