"""Values that replace those of a scenario's file, as in ``controller.gain=2``."""

from typing import Dict, Iterable, List, Tuple

from deformable_manipulation.reading.document import KeyPath, parse_value
from deformable_manipulation.reading.errors import Problem, key_text, show
from deformable_manipulation.reading.readers import nearest

Override = Tuple[str, str]  # key path, value as YAML text


class _Refused(Exception):
    """An override cannot be applied; the message says why."""


def apply_overrides(
    raw, lines: Dict[KeyPath, int], overrides: Iterable[Override]
) -> Tuple[object, Dict[KeyPath, int], List[Problem]]:
    """The raw mapping with values replaced, the lines of what is left of the file, and problems.

    Sections that the file leaves out are made; whether the keys are known is checked with the rest
    of the scenario. List items and agents must be there. ``raw`` is not changed.
    """
    problems = []
    for key, text in overrides:
        path = tuple(key.split("."))
        try:
            value = parse_value(text)
            raw = _replaced(raw, path, 0, value)
        except (_Refused, ValueError) as error:
            problems.append(Problem(key, "cannot be set: {}".format(error), show(text)))
            continue
        lines = {k: line for k, line in lines.items() if k[: len(path)] != path}
    return raw, lines, problems


def _replaced(container, path: KeyPath, depth: int, value):
    """A copy of the container with the item at ``path[depth:]`` replaced."""
    if depth == len(path):
        return value
    key = path[depth]
    if isinstance(container, list):
        index = _list_index(container, path, depth)
        copy = list(container)
        copy[index] = _replaced(container[index], path, depth + 1, value)
        return copy
    if not isinstance(container, dict):
        raise _Refused(
            "{} is {}, which has no keys".format(".".join(path[:depth]), show(container))
        )
    names = [key_text(name) for name in container]
    if depth == 1 and path[0] == "agents" and len(path) > 2 and key not in container:
        raise _Refused(
            "there is no agent '{}';{} agents: {}".format(
                key, nearest(key, names), ", ".join(names)
            )
        )
    return {**container, key: _replaced(container.get(key, {}), path, depth + 1, value)}


def _list_index(container: list, path: KeyPath, depth: int) -> int:
    key = path[depth]
    if not key.isdecimal() or int(key) >= len(container):
        raise _Refused(
            "{} is a list of {}; name an item by its index{}".format(
                ".".join(path[:depth]),
                len(container),
                ", 0 to {}".format(len(container) - 1) if container else "",
            )
        )
    return int(key)
