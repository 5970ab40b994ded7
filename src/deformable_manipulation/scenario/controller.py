"""The ``controller`` section."""

import dataclasses

from deformable_manipulation.reading.readers import (
    LARGEST_COORDINATE,
    Array,
    Auto,
    Choice,
    Flag,
    Node,
    Number,
    Section,
    vector,
)
from deformable_manipulation.scenario.formulation import FULL, PAPER, FormulatedSection
from deformable_manipulation.scenario.spec import (
    CENTRALISED,
    DECENTRALISED,
    CollisionSpec,
    ControllerSpec,
    OverstretchSpec,
    ProximitySpec,
)

# Less would be rounding in the differences between copies, one of which may be at a quarter of it.
_SMALLEST_PERTURBATION = 1e-5  # m

_ALPHA = Array(2, Number("1/s", above=0.0), "[slope for h >= 0, slope for h < 0]")


_MARGIN = Number("m", at_least=0.0, at_most=LARGEST_COORDINATE)

_LIMITS = ("collision", "overstretch", "proximity")


class QpSolver:
    """The package's own solver, or one that qpsolvers offers on this machine."""

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


class Priority(Array):
    """An order of the limits; returns a tuple."""

    def __init__(self):
        super().__init__(len(_LIMITS), Choice(*_LIMITS), "[yields last, then, yields first]")

    def __call__(self, node: Node):
        order = super().__call__(node)
        if sorted(order) != sorted(_LIMITS):
            node.fail("must name each of {} once".format(", ".join(_LIMITS)))
        return order


COLLISION = Section(
    CollisionSpec,
    {
        "offset": Number("m", at_least=0.0, at_most=LARGEST_COORDINATE),
        "alpha": _ALPHA,
        "anticipation": _ALPHA,
        "margin": _MARGIN,
        "speed_margin": Number("s", at_least=0.0, at_most=10.0),
        "band": Number("m", at_least=0.0, at_most=LARGEST_COORDINATE),
        "obstacle_velocity": Flag(),
        "gradient": Choice("features", "minimum"),
        "backend": Choice("native", "reference"),
    },
)

OVERSTRETCH = Section(
    OverstretchSpec,
    {
        "max_distance": Auto("m", above=0.0),
        "fraction": Number("1", above=0.0, at_most=1.0),
        "margin": _MARGIN,
        "alpha": _ALPHA,
    },
)

PROXIMITY = Section(
    ProximitySpec,
    {"min_distance": Auto("m", at_least=0.0), "margin": _MARGIN, "alpha": _ALPHA},
)

CONTROLLER = FormulatedSection(
    ControllerSpec,
    {
        "formulation": Choice(FULL, PAPER),
        "cooperation": Choice(DECENTRALISED, CENTRALISED),
        "priority": Priority(),
        "rate": Number("Hz", at_least=0.1, at_most=10000.0),
        "gain": Number("1/s", above=0.0),
        "weights": vector("1", at_least=1e-6, at_most=1e6),
        "max_velocity": Number("m/s", above=0.0, at_most=10.0),
        "max_acceleration": Number("m/s^2", above=0.0, at_most=1000.0),
        "smoothing": Number("s", at_least=0.0, at_most=10.0),
        "perturbation": vector("m", smallest_size=_SMALLEST_PERTURBATION),
        "jacobian": Choice("perturbed_copies", "equilibrium"),
        "differences": Choice("central", "forward"),
        "feedforward": Flag(),
        "solver": QpSolver(),
        "timeout": Number("s", above=0.0, at_most=1e6),
        "pose_smoothing": Number("s", at_least=0.0, at_most=10.0),
        "collision": COLLISION,
        "overstretch": OVERSTRETCH,
        "proximity": PROXIMITY,
    },
    # What it is depends on the object: for_object() fills it in.
    defaults={"jacobian": None},
)


def for_object(controller: ControllerSpec, spec) -> ControllerSpec:
    """The section with what depends on the object filled in: exact gradients where it has them."""
    if controller.jacobian is not None:
        return controller
    return dataclasses.replace(controller, jacobian=spec.default_jacobian)
