"""Masses that a rod carries at places: markers, plugs, end fittings."""

from dataclasses import dataclass
from typing import Sequence

from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.parameter import parameter
from deformable_manipulation.reading.readers import Node, Number, Section


@dataclass(frozen=True)
class PointMass:
    """A mass at a place along a rod."""

    at: float = parameter(
        Number("m", at_least=0.0),
        "Where it is along the rod, from its first end.",
        allowed="at most `length`",
        native=True,
    )
    mass: float = parameter(Number("kg", above=0.0, at_most=1e4), "Its mass.", native=True)


POINT_MASS = Section(PointMass)


def check_point_masses(node: Node, masses: Sequence[PointMass], length: float) -> bool:
    """Report masses that are not on a rod of a length [m]; returns whether all are."""
    for number, point in enumerate(masses):
        if point.at > length:
            node.report.add(
                node.path + ("point_masses", str(number), "at"),
                "must be a place on the rod, 0 to {:g} m".format(length),
                show(point.at),
            )
    return all(point.at <= length for point in masses)
