"""Points as lines of numbers: .xyz and the like."""

from typing import Optional

import numpy as np

from deformable_manipulation.mesh_formats.faces import FormatError
from deformable_manipulation.mesh_formats.numbers_in_text import (
    content_lines,
    decoded,
    number_of,
    shown,
)

_SEPARATORS = str.maketrans(",;\t", "   ")


def read(data: bytes) -> np.ndarray:
    """The first three numbers of each line (N, 3); a first line of words is passed over.

    Raises:
        FormatError: with the line.
    """
    text = decoded(data).translate(_SEPARATORS)
    first, _, rest = text.partition("\n")
    words = first.partition("#")[0].split()
    has_heading = bool(words) and all(number_of(word) is None for word in words)
    rows = table(rest if has_heading else text, 1 if has_heading else 0)
    if rows.shape[1] < 3:
        raise FormatError("its lines have fewer than three numbers")
    return rows[:, :3]


def table(text: str, lines_before: int) -> np.ndarray:
    """Numbers (N, K) of lines with as many on each; empty lines and comments are passed over.

    Args:
        text: the lines.
        lines_before: how many there are in the file before, for messages.

    Raises:
        FormatError: with the line.
    """
    rows = [content.split() for _, content in content_lines(text)]
    try:
        numbers: Optional[np.ndarray] = np.array(rows, dtype=float)
    except ValueError:
        numbers = None
    if numbers is not None and (numbers.ndim == 2 or not rows):
        return numbers.reshape(len(rows), -1 if rows else 3)
    for number, content in content_lines(text):
        words = content.split()
        if len(words) != len(rows[0]) or None in map(number_of, words):
            raise FormatError(
                "line {}: {} are not {} numbers, as on the first line".format(
                    number + lines_before, shown(content), len(rows[0])
                )
            )
    raise FormatError("its lines are no numbers")
