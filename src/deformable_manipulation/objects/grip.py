"""Places at which a rod is held, and the lengths that the grippers keep straight."""

from dataclasses import dataclass
from typing import Optional, Sequence

from deformable_manipulation.reading.errors import show
from deformable_manipulation.reading.parameter import parameter
from deformable_manipulation.reading.readers import Auto, Integer, Node, Section

GRIP_LENGTH = Auto("m", at_least=0.0)


@dataclass(frozen=True)
class Grip:
    """A held segment of a rod."""

    particle: int = parameter(
        Integer(0, 10000),
        "The held segment.",
        allowed="below `segments`, in ascending order",
        native=True,
    )
    length: Optional[float] = parameter(
        GRIP_LENGTH,
        "Length of the rod that the gripper keeps straight, its width. `auto`: that of a segment.",
        default=None,
        default_text="`auto`",
        allowed="below the rod's length",
        native=True,
    )


GRIP = Section(Grip)


def check_grips(node: Node, grips: Sequence[Grip], length: float, segments: int) -> bool:
    """Report grips that are not on a rod of a length [m] in segments; returns whether all are."""
    good = True
    for number, grip in enumerate(grips):
        path = node.path + ("grips", str(number))
        least = grips[number - 1].particle + 1 if number else 0
        if not least <= grip.particle < segments:
            node.report.add(
                path + ("particle",),
                "must be a segment, {} to {}: grips stand in the order of their segments".format(
                    least, segments - 1
                ),
                show(grip.particle),
            )
            good = False
        if grip.length is not None and grip.length >= length:
            node.report.add(
                path + ("length",),
                "must be less than object.length ({:g} m)".format(length),
                show(grip.length),
            )
            good = False
    return good
