"""What the barriers on what the object bears have in common: its loads."""

import dataclasses
from typing import Any, Dict, Tuple

import numpy as np

from deformable_manipulation.objects.rod import RodSpec
from deformable_manipulation.reading.parameter import parameter
from deformable_manipulation.reading.readers import Number, Slopes, vector
from deformable_manipulation.scenario.barriers.kind import BarrierKind

_NO_LIMIT = 1e6  # N or N m, of the C++ core, too


def limit_parameter(unit: str, meaning: str) -> Any:
    """The parameter with the limit of a load."""
    return parameter(Number(unit, above=0.0, at_most=1e6), meaning, native=True)


def per_axis_parameter(unit: str, quantity: str) -> Any:
    """The parameter with the limits of a grip's force or torque along each of its axes."""
    return parameter(
        vector(unit, above=0.0, at_most=_NO_LIMIT),
        f"Greatest part of the {quantity} along each axis of the grip's frame, either way, where "
        "limits of a wrist or a coupling differ: x is along the held segment. 1e6: no limit.",
        default=(_NO_LIMIT,) * 3,
        default_text="no limits",
        native=True,
    )


def orientations_of_grips(scenario) -> Dict[str, Any]:
    """The ``derive`` of a barrier on the grips: how each agent's grip is turned at the start."""
    return {"orientations": [list(agent.orientation) for agent in scenario.agents]}


def load_barrier(name: str, limits: Dict[str, Any], meaning: str, **declaration) -> BarrierKind:
    """The declaration of a barrier on a load, which is in use where the scenario has its section.

    Args:
        name: of the barrier.
        limits: parameters by their keys, those without defaults first.
        meaning: of the section, without the reference to its page.
        **declaration: the other attributes of BarrierKind.
    """
    return BarrierKind(
        name=name,
        spec=_spec(name, limits),
        meaning=f"{meaning} See [loads](barriers/loads.md).",
        default=None,
        **declaration,
    )


def _spec(name: str, limits: Dict[str, Any]) -> type:
    """The dataclass of a section with these limits, and with what all loads have."""
    slopes = Tuple[float, float]
    common = [("reserve", float, _reserve_parameter()), ("alpha", slopes, _alpha_parameter())]
    own = [(key, Any, limit) for key, limit in limits.items()]
    title = "".join(part.title() for part in name.split("_")) + "Spec"
    spec = dataclasses.make_dataclass(title, [*own, *common], frozen=True)
    spec.__module__ = __name__  # where pickle looks for it
    globals()[title] = spec
    return spec


def _reserve_parameter() -> Any:
    return parameter(
        Number("1", at_least=0.0, at_most=0.9),
        "Part of the limit that the rows stay within it. Raise it if the object swings.",
        default=0.02,
        paper=0.0,
        native=True,
    )


def _alpha_parameter() -> Any:
    return parameter(
        Slopes(),
        "How fast h may shrink, per unit of h left, and how fast a violation is corrected.",
        default=(1.0, 2.0),
        native=True,
    )


def demand_rod(name: str, why: str):
    """The ``check`` of a barrier that is for rods alone.

    Args:
        name: of the barrier.
        why: a clause that says why not for others.
    """

    def check(report, spec, _agents, _controller) -> None:
        if not isinstance(spec, RodSpec):
            report.add(
                ("controller", name),
                f"is for ropes and rods: {why}. Remove the section",
                spec.type,
            )

    return check


def weights_between_grips(scenario) -> Dict[str, Any]:
    """The ``derive`` of a barrier on joints: weights of the segments, particles that are held."""
    rod = scenario.object
    plain = rod.mass_per_length * rod.length / rod.segments  # kg, of a segment that carries nothing
    masses, moments = rod.segment_masses()
    return {
        "weight": [plain * component for component in scenario.simulation.gravity],
        "masses": np.stack((masses / plain, moments / plain), axis=1),
        "particles": [agent.particle for agent in scenario.agents],
    }
