"""The section ``controller.horizon``: how far the controllers look ahead."""

from dataclasses import dataclass

from deformable_manipulation.geometry.pose import Vector
from deformable_manipulation.reading.parameter import parameter
from deformable_manipulation.reading.readers import Choice, Integer, Number, vector

_MOST_NODES = 32


@dataclass(frozen=True)
class HorizonSpec:
    """How far the controllers look ahead."""

    length: float = parameter(
        Number("s", at_least=0.0, at_most=30.0),
        "How far ahead the controllers look: what cannot be answered later is answered now. 0: "
        "only the present cycle counts.",
        default=0.0,
        paper=0.0,
        native=True,
    )
    nodes: int = parameter(
        Integer(at_least=1, at_most=_MOST_NODES),
        "At how many times within it the object, its distances and the limits are predicted. More "
        "take longer.",
        default=8,
        native=True,
    )
    leader: str = parameter(
        Choice("fading", "path"),
        "What the leader is expected to do.",
        default="fading",
    )
    weights: Vector = parameter(
        vector("1", at_least=1e-6, at_most=1e6),
        "Cost of departing from the nominal velocity for the sake of later, per axis.",
        default=(1.0, 1.0, 0.1),
        native=True,
    )
    leader_fade: float = parameter(
        Number("s", above=0.0, at_most=100.0),
        "Time constant with which the leader's velocity is expected to fade.",
        default=1.0,
        native=True,
    )
