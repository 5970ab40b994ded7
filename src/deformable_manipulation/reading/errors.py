"""What is wrong with a scenario: every mistake with its key, value and remedy."""

import reprlib
from dataclasses import dataclass
from typing import Iterable, Optional


class _YamlRepr(reprlib.Repr):
    """Shows values as they stand in YAML, on one line and of bounded length."""

    def __init__(self):
        super().__init__()
        self.maxlevel = 3
        self.maxlist = 4
        self.maxdict = 4
        self.maxstring = 60
        self.maxother = 60

    def repr_bool(self, value, level):
        return "true" if value else "false"

    def repr_NoneType(self, value, level):
        return "empty"

    def repr_int(self, value, level):
        # Python refuses to print integers of thousands of digits.
        return repr(value) if abs(value) < 10**40 else "an integer of more than 40 digits"


_SHOWN = _YamlRepr()
_LONGEST = 100


def show(value) -> str:
    """The value as text for a message: one line, shortened where it is long."""
    text = " ".join(_SHOWN.repr(value).split())
    return text if len(text) <= _LONGEST else text[: _LONGEST - 3] + "..."


def key_text(key) -> str:
    """A key of a mapping as text: as it stands if it is a word, else as a value would be shown."""
    return key if isinstance(key, str) and key.isprintable() else show(key)


@dataclass(frozen=True)
class Problem:
    """One mistake.

    ``key`` is the path in the file with list items by index, as in
    ``leader.waypoints.1.time`` (empty: the file as a whole); ``value`` is the value as text (empty:
    there is none); ``line`` counts from 1.
    """

    key: str
    message: str
    value: str = ""
    line: Optional[int] = None

    def __str__(self) -> str:
        text = "{} \u2014 {}".format(self.value, self.message) if self.value else self.message
        if self.key:
            text = "{}: {}".format(self.key, text)
        return text if self.line is None else "{} (line {})".format(text, self.line)


class ScenarioError(ValueError):
    """A scenario cannot be used; ``problems`` holds every mistake that was found.

    ``source`` is the file, or empty if the scenario did not come from a file.
    """

    def __init__(self, problems: Iterable[Problem], source: str = ""):
        self.problems = tuple(problems)
        self.source = source
        super().__init__(self.problems, source)

    def __str__(self) -> str:
        count = len(self.problems)
        heading = "{}: {}".format(
            self.source or "scenario", "1 mistake" if count == 1 else "{} mistakes".format(count)
        )
        return "\n".join([heading] + ["  {}".format(problem) for problem in self.problems])
