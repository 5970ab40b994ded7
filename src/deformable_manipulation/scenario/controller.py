"""The ``controller`` section: its parameters, and the barriers' sections in it."""

import dataclasses
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Dict, Optional, Tuple

from deformable_manipulation.geometry.pose import Vector
from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.parameter import (
    NOTHING,
    SIMULATOR,
    Live,
    parameter,
)
from deformable_manipulation.reading.readers import (
    Array,
    Choice,
    Flag,
    Node,
    Number,
    Report,
    vector,
)
from deformable_manipulation.scenario.barriers import BARRIERS
from deformable_manipulation.scenario.horizon import HORIZON, HorizonSpec
from deformable_manipulation.scenario.orientation import FIXED, FOLLOW, FREE
from deformable_manipulation.scenario.wrench_watch import WRENCH_WATCH, WrenchWatchSpec

COORDINATED = "coordinated"
DECENTRALISED = "decentralised"
CENTRALISED = "centralised"
FULL, PAPER = "full", "paper"

# Less would be rounding in the differences between copies, one of which may be at a quarter of it.
_SMALLEST_PERTURBATION = 1e-5  # m


class QpSolver:
    """The package's own solver, or one that qpsolvers offers on this machine."""

    type, unit = "text", ""
    range = "`native`, dense solvers of qpsolvers that are installed"
    allowed = "native, or the name of a dense solver of qpsolvers that is installed"

    def __call__(self, node: Node) -> str:
        if node.value == "native":
            return node.value
        try:
            import qpsolvers  # slow to import, and only needed here
        except ImportError:
            return self._any_name(node)
        return Choice("native", *qpsolvers.dense_solvers)(node)

    def _any_name(self, node: Node) -> str:
        if not isinstance(node.value, str) or not node.value:
            node.fail("must be {}".format(self.allowed))
        return node.value


class Priority:
    """An order of barriers; returns a tuple of their names."""

    type, unit, range = "list of text", "", "the name of each barrier in use once"
    allowed = "a list of the names of the barriers in use; the first one yields last"

    def __call__(self, node: Node) -> Tuple[str, ...]:
        if not isinstance(node.value, (list, tuple)):
            node.fail("must be {}".format(self.allowed))
        order = Array(len(node.value), Choice(*BARRIERS), "")(node)
        if len(set(order)) < len(order):
            node.fail("must name each of {} once".format(", ".join(BARRIERS)))
        return order


@dataclass(frozen=True)
class _ControllerKeys:
    """The parameters of the assistants' safe velocity controller, but for its barriers."""

    formulation: str = parameter(
        Choice(FULL, PAPER),
        "`full`: all of [mathematics.md](mathematics.md#barriers). `paper`: the paper's equations "
        "as they are, for comparison, see [below](#the-papers-formulation).",
        default=FULL,
        native=True,
    )
    cooperation: str = parameter(
        Choice(COORDINATED, DECENTRALISED, CENTRALISED),
        "`coordinated`: each assistant solves one quadratic program for all and follows its own "
        "part. Assistants tell one another their intents; while one is not heard, the others take "
        "their shares only. `decentralised`: each assistant decides for itself, and assistants "
        "share the limits that several of them can act on. `centralised`: one quadratic program "
        "for all assistants, in one process. See "
        "[safety.md](safety.md#coordinated-decentralised-or-centralised).",
        default=COORDINATED,
        paper=DECENTRALISED,
    )
    priority: Optional[Tuple[str, ...]] = parameter(
        Priority(),
        "Which limit yields when not all of them can hold: the first one yields last.",
        default=None,
        default_text="`[{}]`, those in use".format(", ".join(BARRIERS)),
        native=True,
    )
    rate: float = parameter(
        Number("Hz", at_least=0.1, at_most=10000.0),
        "Commands per second. Lower it if the machine does not keep up.",
        default=100.0,
    )
    gain: float = parameter(
        Number("1/s", above=0.0),
        "k_p: how fast an assistant closes in on its place.",
        default=1.0,
        allowed="below `rate`",
        live=Live(("gain",), 0.01, 20.0),
        native=True,
    )
    weights: Vector = parameter(
        vector("1", at_least=1e-6, at_most=1e6),
        "gamma: cost of leaving the nominal velocity, per axis. Raise one to keep an assistant "
        "from giving way along that axis.",
        default=(1.0, 1.0, 1.0),
        allowed="at most a factor of 100 apart",
        live=Live(("weight_x", "weight_y", "weight_z"), 0.01, 100.0),
        native=True,
    )
    max_velocity: float = parameter(
        Number("m/s", above=0.0, at_most=10.0),
        "Bound on every component of the command. Use the robot's limit.",
        default=0.15,
        live=Live(("max_velocity",), 0.001, 2.0),
        native=True,
    )
    max_acceleration: float = parameter(
        Number("m/s^2", above=0.0, at_most=1000.0),
        "Bound on every component of the command's change. Use the robot's limit.",
        default=1.0,
        live=Live(("max_acceleration",), 0.01, 20.0),
        native=True,
    )
    max_jerk: float = parameter(
        Number("m/s^3", above=0.0, at_most=1e6),
        "Bound on every component of the change of acceleration from command to command, over the "
        "cycle time. Use the robot's limit; what its driver makes of steps in the command is in "
        "[real_robot.md](real_robot.md#what-the-driver-has-to-do-between-commands).",
        default=1000.0,
        live=Live(("max_jerk",), 0.1, 1e6),
        native=True,
    )
    orientation: str = parameter(
        Choice(FIXED, FOLLOW, FREE),
        "What the assistants' grips do about their orientations. `fixed`: they keep them. "
        "`follow`: the formation turns with the leader, places and grips. `free`: they want to "
        "keep them, and turn where that serves the limits. See "
        "[mathematics.md](mathematics.md#grips-that-turn).",
        default=FIXED,
        paper=FIXED,
        allowed="`fixed` for fabrics, grips that are `pinned`, and `jacobian: perturbed_copies`",
        native=True,
    )
    turning_gain: float = parameter(
        Number("1/s", above=0.0, at_most=100.0),
        "How fast a grip turns back to the orientation that it wants.",
        default=0.5,
        native=True,
    )
    turning_weights: Vector = parameter(
        vector("m", at_least=1e-6, at_most=1e6),
        "Cost of leaving the nominal angular velocity, per axis, beside `weights`: the length over "
        "which turning by 1 rad costs as much as moving. Lower it to let grips turn before they "
        "give way.",
        default=(0.3, 0.3, 0.3),
        native=True,
    )
    max_angular_velocity: float = parameter(
        Number("rad/s", above=0.0, at_most=10.0),
        "Bound on every component of the commanded angular velocity. Use the robot's limit.",
        default=0.5,
        native=True,
    )
    max_angular_acceleration: float = parameter(
        Number("rad/s^2", above=0.0, at_most=1000.0),
        "Bound on every component of its change. Use the robot's limit.",
        default=2.0,
        native=True,
    )
    smoothing: float = parameter(
        Number("s", at_least=0.0, at_most=10.0),
        "Time constant with which the deviation from the nominal velocity changes where the limits "
        "leave a choice. It keeps the command from jumping when other rows become active. Limits "
        "still act at once. 0 switches it off.",
        default=0.2,
        paper=0.0,
        live=Live(("smoothing",), 0.0, 10.0),
        native=True,
    )
    disturbance_filter: float = parameter(
        Number("s", at_least=0.0, at_most=10.0),
        "Time constant of the disturbance observer. It measures how much faster a distance falls "
        "than the gradients and the known velocities explain, for example because the object "
        "swings, its material differs, or the velocity of an obstacle is not known. The rows "
        "include that rate. Raise it for noisy poses; 0 switches it off. The gradients of fabrics "
        "are too coarse for it.",
        default=0.1,
        default_text="`0.1`; for fabrics `0`",
        paper=0.0,
        live=Live(("disturbance_filter",), 0.0, 10.0),
        native=True,
    )
    horizon: HorizonSpec = parameter(
        HORIZON,
        "How far the controllers look ahead, see [mathematics.md](mathematics.md#horizon).",
        default=HorizonSpec(),
        default_text="all defaults",
        native=True,
    )
    detours: bool = parameter(
        Flag(),
        "Whether an assistant that is held off its place, behind a leader at rest, looks for a way "
        "around and takes it. For rods, and obstacles whose poses are not measured. See "
        "[safety.md](safety.md#detours).",
        default=True,
        paper=False,
    )
    perturbation: Vector = parameter(
        vector("m", smallest_size=_SMALLEST_PERTURBATION),
        "Displacement of the held point in the copy of each axis. It may be negative. Smaller "
        "values give a more local gradient.",
        default=(0.1, 0.1, 0.1),
        allowed="smaller than the shortest free length between two agents",
        live=Live(
            ("perturbation_x", "perturbation_y", "perturbation_z"), -1.0, 1.0, node=SIMULATOR
        ),
    )
    jacobian: str = parameter(
        Choice("perturbed_copies", "equilibrium"),
        "Where the gradients come from. `equilibrium`: the exact response of the object in its "
        "equilibrium; the copies take over in cycles where it is not known. `perturbed_copies`: "
        "differences between perturbed copies (the paper). The exact response of a fabric costs "
        "more than its copies and is for fabrics that are stiff in their plane.",
        default="equilibrium",
        default_text="`equilibrium`; for fabrics `perturbed_copies`",
        paper="perturbed_copies",
        native=True,
    )
    differences: str = parameter(
        Choice("central", "forward"),
        "`central`: copies on both sides, whose difference has no bias of first order. `forward`: "
        "copies on one side only (the paper).",
        default="central",
        paper="forward",
    )
    feedforward: bool = parameter(
        Flag(),
        "Whether the nominal law and the barriers use the leader's measured velocity.",
        default=True,
        paper=False,
        native=True,
    )
    solver: str = parameter(
        QpSolver(),
        "Solver of the quadratic program. All but `native` are for comparison, and slower.",
        default="native",
    )
    timeout: float = parameter(
        Number("s", above=0.0, at_most=1e6),
        "Age at which an input counts as lost and the assistant stops.",
        default=0.2,
        allowed="at least one cycle",
        native=True,
    )
    pose_smoothing: float = parameter(
        Number("s", at_least=0.0, at_most=10.0),
        "Time constant of the filter of measured poses (agents with `driven_by: pose`, and "
        "[knowledge](#knowledge)). Raise it for noisier poses; 0 switches it off. Agents that move "
        "as commanded are not filtered.",
        default=0.2,
    )

    wrench_watch: Optional[WrenchWatchSpec] = parameter(
        WRENCH_WATCH,
        "Stops an assistant whose force sensor, on `<assistant>/measured_wrench`, does not measure "
        "what the model says. See [real_robot.md](real_robot.md#force-sensors). Under ROS only.",
        default=None,
        default_text="none: no force sensors",
    )

    @property
    def barriers(self) -> Tuple[str, ...]:
        """Names of the barriers in use, in their order."""
        return tuple(name for name in BARRIERS if getattr(self, name) is not None)

    @property
    def turns(self) -> bool:
        """Whether grips turn."""
        return self.orientation != FIXED

    @property
    def needs_wrenches(self) -> bool:
        """Whether something in use depends on what the object exerts on the agents."""
        of_barriers = any(BARRIERS[name].needs_wrenches for name in self.barriers)
        return of_barriers or self.wrench_watch is not None


def _with_barriers(keys: type) -> type:
    """A class with a field for each barrier's section beside the fields of ``keys``."""
    fields = [(name, Any, kind.field()) for name, kind in BARRIERS.items()]
    required = [field for field in fields if BARRIERS[field[0]].default is NOTHING]
    optional = [field for field in fields if field not in required]
    # A dataclass takes the fields of its last base first, and those without defaults come first.
    first = dataclasses.make_dataclass("_RequiredBarriers", required, frozen=True)
    made = dataclasses.make_dataclass("ControllerSpec", optional, bases=(keys, first), frozen=True)
    made.__module__ = __name__  # where pickle looks for it
    made.__doc__ = "The assistants' safe velocity controller: its parameters and its barriers."
    return made


if TYPE_CHECKING:

    class ControllerSpec(_ControllerKeys):
        """The assistants' safe velocity controller: its parameters and its barriers."""

        def __init__(self, **values: Any) -> None: ...
        def __getattr__(self, name: str) -> Any: ...
else:
    ControllerSpec = _with_barriers(_ControllerKeys)


def for_object(controller: ControllerSpec, spec) -> ControllerSpec:
    """The section with what depends on the object and on its barriers filled in."""
    filled: Dict[str, Any] = {}
    for key in ("jacobian", "disturbance_filter"):
        if getattr(controller, key) is None:
            filled[key] = getattr(spec, key)
    if controller.horizon.length is None:
        filled["horizon"] = dataclasses.replace(controller.horizon, length=spec.horizon_length)
    for name in controller.barriers:
        filled[name] = BARRIERS[name].for_object(getattr(controller, name), spec)
    if controller.priority is None:
        filled["priority"] = controller.barriers
    return dataclasses.replace(controller, **filled)


def check_priority(report: Report, controller: ControllerSpec) -> None:
    """The priority names the barriers in use, and no others."""
    if controller.priority is not None and set(controller.priority) != set(controller.barriers):
        report.add(
            ("controller", "priority"),
            "must name each barrier in use once: {}".format(", ".join(controller.barriers)),
            show(list(controller.priority)),
        )
