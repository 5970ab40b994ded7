"""The section ``controller.horizon``: how far the controllers look ahead."""

from dataclasses import dataclass

from deformable_manipulation.geometry.pose import Vector
from deformable_manipulation.reading.parameter import Live, parameter
from deformable_manipulation.reading.readers import Choice, Integer, Number, Section, vector

FADING, ANNOUNCED, KNOWN = "fading", "announced", "known"


@dataclass(frozen=True)
class HorizonSpec:
    """How far the controllers look ahead."""

    length: float = parameter(
        Number("s", at_least=0.0, at_most=30.0),
        "How far ahead the limits are checked. What could not be answered later is answered now. "
        "Raise it for leaders that are faster than the assistants; 0 looks at the present cycle "
        "only. Fabrics are predicted to first order, which helps some of their runs and harms "
        "others.",
        default=3.0,
        default_text="`3`; for fabrics `0`",
        paper=0.0,
        native=True,
    )
    nodes: int = parameter(
        Integer(at_least=1, at_most=32),
        "Number of times within `length` at which the object, its distances and the limits are "
        "predicted. Eight shapes of a rod cost as much as one.",
        default=8,
        native=True,
    )
    leader: str = parameter(
        Choice(FADING, ANNOUNCED, KNOWN),
        "What the leader is expected to do. `fading`: go on with a velocity that fades. "
        "`announced`: what it announces on `<leader>/intent`, as far as that has been true lately; "
        "scripted leaders announce their path. `known`: what it announces, whatever has become of "
        "that before; for scripted leaders.",
        default=FADING,
        native=True,
    )
    leader_fade: float = parameter(
        Number("s", above=0.0, at_most=1000.0),
        "Time constant with which the leader's present velocity is expected to fade. Lower it for "
        "leaders that change direction often.",
        default=3.0,
        live=Live(("horizon_leader_fade",), 0.01, 100.0),
        native=True,
    )
    leader_doubt: float = parameter(
        Number("1", at_least=0.0, at_most=10.0),
        "How much smaller than predicted a distance may be, per metre that the leader would travel "
        "at its recent speed until then. Raise it where the leader turns without warning.",
        default=0.3,
        live=Live(("horizon_leader_doubt",), 0.0, 10.0),
        native=True,
    )
    leader_memory: float = parameter(
        Number("s", above=0.0, at_most=1000.0),
        "Time constant with which the highest recent speed of the leader is forgotten. A leader "
        "that was fast may be so again after a pause.",
        default=5.0,
        live=Live(("horizon_leader_memory",), 0.01, 100.0),
        native=True,
    )
    obstacle_doubt: float = parameter(
        Number("1", at_least=0.0, at_most=10.0),
        "How much smaller than predicted the distance from an obstacle may be whose pose is "
        "measured, per metre that it would travel at its present velocity until then. Raise it "
        "for obstacles that turn without warning.",
        default=0.2,
        live=Live(("horizon_obstacle_doubt",), 0.0, 10.0),
        native=True,
    )
    weights: Vector = parameter(
        vector("1", at_least=1e-6, at_most=1e6),
        "Cost per axis of leaving the nominal velocity early, behind a leader that moves at "
        "`max_velocity` or faster. Behind a slower leader they turn into `controller.weights`. The "
        "default gives way upwards, from where an assistant can come back.",
        default=(1.0, 1.0, 0.1),
        allowed="at most a factor of 100 apart",
        live=Live(("horizon_weight_x", "horizon_weight_y", "horizon_weight_z"), 0.01, 100.0),
        native=True,
    )

    @property
    def announced(self) -> bool:
        """Whether the controllers want to know where the leader will be."""
        return self.length > 0.0 and self.leader != FADING


# The length depends on the object where it is left out: controller.for_object() fills it in.
HORIZON = Section(HorizonSpec, defaults={"length": None})
HORIZON_OF_OBJECT = HorizonSpec(**HORIZON.defaults)
