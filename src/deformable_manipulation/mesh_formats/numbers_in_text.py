"""Lines and numbers of mesh files that are text."""

from typing import Iterator, List, Optional, Sequence, Tuple

import numpy as np

from deformable_manipulation.mesh_formats.faces import FormatError

_MARKS = ((b"\xef\xbb\xbf", "utf-8"), (b"\xff\xfe", "utf-16-le"), (b"\xfe\xff", "utf-16-be"))
_SHOWN = 40  # characters of a line


def decoded(data: bytes) -> str:
    """The text of a file, whose names and comments may be in any encoding."""
    for mark, encoding in _MARKS:
        if data.startswith(mark):
            return data[len(mark) :].decode(encoding, errors="replace")
    return data.decode("latin-1")


def shown(text: str) -> str:
    """The beginning of a line for a message, without what cannot be printed."""
    text = " ".join(text.split())
    text = text if len(text) <= _SHOWN else text[:_SHOWN] + "..."
    return "'{}'".format("".join(c if c.isprintable() else "?" for c in text))


def content_lines(text: str) -> Iterator[Tuple[int, str]]:
    """Numbers, from 1, and contents of the lines that are not empty, without comments (#)."""
    for number, line in enumerate(text.splitlines(), start=1):
        content = line.partition("#")[0].strip()
        if content:
            yield number, content


def vertices_of(rows: Sequence[List[str]], lines: Sequence[int]) -> np.ndarray:
    """Vertices (V, 3) of words, which stand on these lines.

    Raises:
        FormatError: a word is no number; with its line.
    """
    try:
        return np.array(rows, dtype=float).reshape(-1, 3)
    except ValueError:
        for row, line in zip(rows, lines):
            if len(row) != 3 or None in map(number_of, row):
                text = "line {}: {} are not the three coordinates of a vertex"
                raise FormatError(text.format(line, shown(" ".join(row)))) from None
        raise


def number_of(word: str) -> Optional[float]:
    """The number that a word is; None if it is none."""
    try:
        return float(word)
    except ValueError:
        return None
