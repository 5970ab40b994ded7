"""Why random variations could not be started: the most frequent reasons, with their counts."""

import re
from collections import Counter
from typing import Dict

from deformable_manipulation.reading.errors import ScenarioError

_NUMBER = re.compile(r"-?\d+(\.\d+)?(e[-+]?\d+)?")
_MOST = 3  # that are told


class Reasons:
    """Counts reasons, of which those that differ in numbers alone are one."""

    def __init__(self) -> None:
        self._counts: Counter = Counter()
        self._first: Dict[str, str] = {}

    def add(self, reason: object) -> None:
        """Take in a text or an error."""
        text = str(reason)
        if isinstance(reason, ScenarioError):
            text = "; ".join(map(str, reason.problems))
        kind = _NUMBER.sub("#", text)
        self._counts[kind] += 1
        self._first.setdefault(kind, text)

    def __str__(self) -> str:
        """The most frequent ones, such as ``62 times: the object starts too close``."""
        told = self._counts.most_common(_MOST)
        texts = [f"{count} times: {self._first[kind]}" for kind, count in told]
        rest = sum(self._counts.values()) - sum(count for _, count in told)
        if rest:
            texts.append(f"{rest} times: something else")
        return "; ".join(texts)
