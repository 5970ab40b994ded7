"""Readers of checked values: each turns a node of the raw file into a value or reports why not.

A reader is called with a :class:`Node` and returns the value. Where the node does not hold one it
reports the problem and raises :class:`Unreadable`; readers of lists and sections first try all
their parts, so that one pass finds every mistake. ``allowed`` says in words what a reader takes;
``type``, ``unit`` and ``range`` say it in the columns of docs/parameters.md.
"""

import dataclasses
import difflib
import math
import numbers
from functools import partial
from pathlib import Path
from typing import Any, Callable, Dict, Iterable, List, Mapping, NoReturn, Optional, Sequence, Tuple

from deformable_manipulation.reading.errors import Problem, key_text, show
from deformable_manipulation.reading.parameter import Parameter, declared

LARGEST_COORDINATE = 1e6  # m; beyond it distances lose the precision that safety needs
_UNIT_NORM = 1e-12  # quaternions this near to unit norm stay as they are, so that reading is stable
_NEAR_UNIT_NORM = 1e-3


class Unreadable(Exception):
    """A node holds no acceptable value; the problem has been reported."""


class Report:
    """Collects problems; knows the lines of the file's keys, and the keys that ``--set`` gave."""

    def __init__(
        self,
        lines: Optional[Mapping[Tuple[str, ...], int]] = None,
        overridden: Iterable[Tuple[str, ...]] = (),
    ):
        self.problems: List[Problem] = []
        self._lines = lines or {}
        self._overridden = tuple(overridden)

    def add(self, path: Sequence[str], message: str, value: str = "") -> None:
        """Report a problem of the key at ``path``."""
        path = tuple(path)
        line = self._lines.get(path)
        # File names in messages may hold anything, line breaks included.
        message = " ".join(message.split())
        if any(path[: len(given)] == given for given in self._overridden):
            message += " (given by --set)"
        self.problems.append(Problem(".".join(path), message, value, line))


@dataclasses.dataclass(frozen=True)
class Node:
    """A raw value, the path of its key and where relative file names start.

    ``files_are_read``: the files that it names have been read and found right already.
    ``section``: the mapping, or list, that it is an item of.
    """

    value: Any
    path: Tuple[str, ...]
    report: Report
    directory: Path
    files_are_read: bool = False
    section: Any = None

    def child(self, key, value) -> "Node":
        """The node of an item of this one."""
        return dataclasses.replace(
            self, value=value, path=self.path + (key_text(key),), section=self.value
        )

    def fail(self, message: str) -> NoReturn:
        """Report this node's value as wrong and raise Unreadable."""
        self.report.add(self.path, message, show(self.value))
        raise Unreadable


def read_all(readings: Iterable[Callable[[], Any]]) -> List[Any]:
    """The results of all readings; raises Unreadable after the last when any of them did."""
    results = []
    failed = False
    for reading in readings:
        try:
            results.append(reading())
        except Unreadable:
            failed = True
    if failed:
        raise Unreadable
    return results


def nearest(word: str, known: Iterable[str]) -> str:
    """A hint like " did you mean 'gain'?" for a mistyped word, empty if nothing is near."""
    matches = difflib.get_close_matches(word, list(known), n=1)
    return " did you mean '{}'?".format(matches[0]) if matches else ""


def to_float(value) -> Optional[float]:
    """The value as a float, None if it is no number; a number in a string is one."""
    if isinstance(value, bool) or not isinstance(value, (numbers.Real, str)):
        return None
    try:
        return float(value)
    except OverflowError:
        return math.inf
    except ValueError:
        return None


class Custom:
    """A reader made of a function of a node."""

    unit = range = ""

    def __init__(self, read: Callable[[Node], Any], allowed: str, type: str = "section"):
        self._read = read
        self.allowed = allowed
        self.type = type

    def __call__(self, node: Node):
        return self._read(node)


class Number:
    """A finite number within bounds."""

    type = "number"

    def __init__(
        self,
        unit: str = "",
        above: Optional[float] = None,
        at_least: Optional[float] = None,
        at_most: Optional[float] = None,
        smallest_size: float = 0.0,
    ):
        self.unit = unit
        self._above, self._at_least, self._at_most = above, at_least, at_most
        self._smallest_size = smallest_size
        self.range = self._bounds().strip()
        self.allowed = "a number{}{}".format(self._bounds(), " [{}]".format(unit) if unit else "")

    def _bounds(self) -> str:
        signs = ((" >", self._above), (" >=", self._at_least), (" <=", self._at_most))
        bounds = ["{} {:g}".format(sign, bound) for sign, bound in signs if bound is not None]
        if self._smallest_size:
            bounds.append(" of size >= {:g}".format(self._smallest_size))
        return " and".join(bounds)

    def __call__(self, node: Node) -> float:
        number = to_float(node.value)
        if number is None or not math.isfinite(number) or not self._within(number):
            node.fail("must be {}".format(self.allowed))
        return number

    def _within(self, number: float) -> bool:
        return (
            (self._above is None or number > self._above)
            and (self._at_least is None or number >= self._at_least)
            and (self._at_most is None or number <= self._at_most)
            and abs(number) >= self._smallest_size
        )


class Integer:
    """A whole number within bounds; 28.0 and "28" are accepted for 28."""

    type, unit = "whole number", ""

    def __init__(self, at_least: int, at_most: int):
        self.range = "{} to {}".format(at_least, at_most)
        self._at_least, self._at_most = at_least, at_most
        self.allowed = "a whole number from {} to {}".format(at_least, at_most)

    def __call__(self, node: Node) -> int:
        number = to_float(node.value)
        if (
            number is None
            or not self._at_least <= number <= self._at_most
            or number != math.floor(number)
        ):
            node.fail("must be {}".format(self.allowed))
        return int(number)


class Auto(Number):
    """A number, or ``auto`` (None)."""

    type = "number or `auto`"

    def __init__(self, unit: str = "", **bounds):
        super().__init__(unit, **bounds)
        self.allowed += " or auto"

    def __call__(self, node: Node) -> Optional[float]:
        return None if node.value == "auto" else super().__call__(node)


class Flag:
    """true or false."""

    type, unit, range = "flag", "", "`true`, `false`"
    allowed = "true or false"

    def __call__(self, node: Node) -> bool:
        if not isinstance(node.value, bool):
            node.fail("must be {}".format(self.allowed))
        return node.value


class Text:
    """A string that matches a pattern."""

    type, unit = "text", ""

    def __init__(self, pattern, allowed: str):
        self._pattern = pattern
        self.range = allowed
        self.allowed = allowed

    def __call__(self, node: Node) -> str:
        if not isinstance(node.value, str) or not self._pattern.fullmatch(node.value):
            node.fail("must be {}".format(self.allowed))
        return node.value


class Choice:
    """One of several words."""

    type, unit = "text", ""

    def __init__(self, *words: str):
        self._words = words
        self.range = ", ".join("`{}`".format(word) for word in words)
        self.allowed = "one of {}".format(", ".join(words))

    def __call__(self, node: Node) -> str:
        if not isinstance(node.value, str) or node.value not in self._words:
            hint = nearest(node.value, self._words) if isinstance(node.value, str) else ""
            node.fail("must be {}{}".format(self.allowed, hint and ";" + hint))
        return node.value


class Array:
    """A list of a given length whose items one reader reads; returns a tuple."""

    def __init__(self, length: int, item, form: str):
        self._length, self._item = length, item
        self.type = {2: "two numbers", 3: "vector"}.get(length, "list of {}".format(length))
        self.unit = item.unit
        self.range = "each " + item.range if item.range else ""
        self.allowed = "a list {}, each {}".format(form, item.allowed)

    def __call__(self, node: Node) -> Tuple[Any, ...]:
        if not isinstance(node.value, (list, tuple)) or len(node.value) != self._length:
            node.fail("must be {}".format(self.allowed))
        return read_items(node, self._item)


class Slopes(Array):
    """The slopes of alpha(h), for h >= 0 and h < 0 [1/s]."""

    def __init__(self):
        super().__init__(2, Number("1/s", above=0.0), "[slope for h >= 0, slope for h < 0]")
        self.range = "> 0, below `rate`"


class Items:
    """A list of any length of items that one reader reads; returns a tuple."""

    type, unit, range = "list", "", ""

    def __init__(self, item):
        self.item = item
        self.allowed = "a list, each item {}".format(item.allowed)

    def __call__(self, node: Node) -> Tuple[Any, ...]:
        if not isinstance(node.value, (list, tuple)):
            node.fail("must be {}".format(self.allowed))
        return read_items(node, self.item)


def vector(unit: str, **bounds) -> Array:
    """Reader of [x, y, z]."""
    return Array(3, Number(unit, **bounds), "[x, y, z]")


def position() -> Array:
    """Reader of a position [x, y, z] in m."""
    return vector("m", at_least=-LARGEST_COORDINATE, at_most=LARGEST_COORDINATE)


class UnitQuaternion:
    """A quaternion [x, y, z, w] of nearly unit norm; returns it normalised."""

    type, unit, range = "quaternion", "", "norm 1"
    allowed = "a quaternion [x, y, z, w] of norm 1"
    _components = Array(4, Number(at_least=-2.0, at_most=2.0), "[x, y, z, w]")

    def __call__(self, node: Node) -> Tuple[float, float, float, float]:
        components = self._components(node)
        norm = math.sqrt(math.fsum(c * c for c in components))
        if abs(norm - 1.0) > _NEAR_UNIT_NORM:
            node.fail(
                "must be {}; divide it by its norm (no rotation: [0, 0, 0, 1])".format(self.allowed)
            )
        if abs(norm - 1.0) <= _UNIT_NORM:
            return components
        return tuple(c / norm for c in components)


def read_items(node: Node, reader) -> Tuple[Any, ...]:
    """The items of a list, read by one reader."""
    return tuple(
        read_all(partial(reader, node.child(index, item)) for index, item in enumerate(node.value))
    )


class Section:
    """A mapping with fixed keys that becomes an object of a spec class.

    Args:
        spec: dataclass whose fields are declared by :func:`~.parameter.parameter`; its defaults
            are those of the keys that may be absent.
        defaults: defaults that differ from the declared ones: of what is filled in later.
        also: another dataclass of declared keys that are read here, too, and not of ``spec``.
        others: declarations of further keys that belong here and are read elsewhere.
    """

    type, unit, range = "section", "", ""
    REQUIRED = object()  # in place of a default

    def __init__(
        self,
        spec,
        defaults: Optional[Mapping[str, Any]] = None,
        also: Any = None,
        others: Optional[Mapping[str, Parameter]] = None,
    ):
        more = {} if also is None else declared(also)
        self.declarations = {**more, **declared(spec)}
        self.spec = spec
        self.fields = {key: each.reader for key, (_, each) in self.declarations.items()}
        self._attributes = {key: attribute for key, (attribute, _) in self.declarations.items()}
        self.others = dict(others or {})
        self._known = (*self.others, *self.fields)
        shared = {} if also is None else _spec_defaults(also)
        self.defaults = {**shared, **_spec_defaults(spec), **(defaults or {})}
        self.allowed = "a section with keys {}".format(", ".join(self._known))

    def __call__(self, node: Node):
        values = self.read_parts(node)
        if len(values) < len(self.fields):
            raise Unreadable
        return self.spec(**values)

    def spec_default(self, attribute: str) -> Any:
        """The default of an attribute, or REQUIRED."""
        return self.defaults.get(attribute, self.REQUIRED)

    def read_parts(self, node: Node) -> Dict[str, Any]:
        """The attributes that can be read, those with mistakes left out.

        Unknown keys are reported and passed over. Raises Unreadable where the node is no mapping.
        """
        if not isinstance(node.value, dict):
            node.fail("must be {}".format(self.allowed))
        self._report_unknown(node)
        parts = {}
        for key, reader in self.fields.items():
            attribute = self._attributes.get(key, key)
            try:
                parts[attribute] = self._read_field(node, key, attribute, reader)
            except Unreadable:
                continue
        return parts

    def _read_field(self, node: Node, key: str, attribute: str, reader):
        if key in node.value:
            return reader(node.child(key, node.value[key]))
        default = self.spec_default(attribute)
        if default is self.REQUIRED:
            node.report.add(node.path + (key,), "is missing; give {}".format(reader.allowed))
            raise Unreadable
        return default

    def _report_unknown(self, node: Node) -> None:
        for key in node.value:
            if key not in self._known:
                name = key_text(key)
                hint = nearest(name, self._known) or " remove it;"
                node.report.add(
                    node.path + (name,),
                    "is not a key here;{} known keys: {}".format(hint, ", ".join(self._known)),
                )


def _spec_defaults(spec) -> Dict[str, Any]:
    return {
        field.name: field.default
        for field in dataclasses.fields(spec)
        if field.default is not dataclasses.MISSING
    }
