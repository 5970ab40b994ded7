"""The key ``origin``: what is taken off the coordinates of a shape that lies far away."""

from typing import Tuple

from deformable_manipulation.reading.readers import Array, Node, Number, to_float

ORIGIN_KEY = "origin"
_LARGEST = 1e9
_NUMBER = Number("m", at_least=-_LARGEST, at_most=_LARGEST)
PLANE_ORIGIN = Array(2, _NUMBER, "[a, b]")
SPACE_ORIGIN = Array(3, _NUMBER, "[x, y, z]")


def origin_beside(node: Node, length: int) -> Tuple[float, ...]:
    """The origin in the section of a node; 0 if there is none, or one that is no point.

    A mistake in it is reported where it is read itself.
    """
    section = node.section if isinstance(node.section, dict) else {}
    value = section.get(ORIGIN_KEY)
    read = [to_float(each) for each in value] if isinstance(value, (list, tuple)) else []
    numbers = tuple(each for each in read if each is not None and abs(each) <= _LARGEST)
    return numbers if len(read) == len(numbers) == length else (0.0,) * length
