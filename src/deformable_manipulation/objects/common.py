"""What the sections of several kinds of objects have in common."""

import re
from typing import Dict

from deformable_manipulation.reading.parameter import Parameter
from deformable_manipulation.reading.readers import Choice, Number, Text

# Ropes and rods yield less than a thousandth to any load in use; what is longer has been pulled
# apart, and its shape and distances mean nothing.
LARGEST_VALID_STRETCH = 0.01

DAMPING = Number("1/s", at_least=0.0, at_most=1e4)


def kind_keys(kind: str, given: str) -> Dict[str, Parameter]:
    """Keys that every ``object`` section has, whatever its kind.

    Args:
        kind: word of its ``type``.
        given: keys that a material of this kind gives, in Markdown.
    """
    return {
        "type": Parameter(Choice(kind), "Kind of object."),
        "material": Parameter(
            Text(re.compile(r".+"), "[materials.md](materials.md)"),
            "Gives {}. Keys of the scenario replace those of the material.".format(given),
            default_text="none",
        ),
    }
