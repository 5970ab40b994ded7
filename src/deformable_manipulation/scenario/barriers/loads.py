"""What the barriers on what the object bears have in common: its loads."""

from typing import Any

from deformable_manipulation.objects.rod import RodSpec
from deformable_manipulation.reading.parameter import parameter
from deformable_manipulation.reading.readers import Number, Slopes


def limit_parameter(unit: str, meaning: str) -> Any:
    """The parameter with the limit of a load."""
    return parameter(Number(unit, above=0.0, at_most=1e6), meaning, native=True)


def reserve_parameter() -> Any:
    """The parameter ``reserve``: the part of the limit that the rows keep."""
    return parameter(
        Number("1", at_least=0.0, at_most=0.9),
        "Part of the limit that the rows stay within it. Raise it if the object swings.",
        default=0.02,
        paper=0.0,
        native=True,
    )


def alpha_parameter() -> Any:
    """The parameter ``alpha`` of a load."""
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
