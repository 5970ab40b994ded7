"""Reading a scenario's YAML text: plain values, the line of every key, duplicate keys."""

from dataclasses import dataclass
from pathlib import Path
from typing import Dict, Optional, Tuple

import yaml

from deformable_manipulation.reading.errors import Problem, ScenarioError
from deformable_manipulation.system.text_files import TextFileError, read_text

KeyPath = Tuple[str, ...]

# What PyYAML's constructors let through on scalars with a wrong explicit tag or an impossible date.
_CONSTRUCTOR_ERRORS = (yaml.YAMLError, ValueError, LookupError, AttributeError, TypeError)


@dataclass(frozen=True)
class Document:
    """A parsed file: its value, the line of every key and list item, and its duplicate keys."""

    value: object
    lines: Dict[KeyPath, int]
    problems: Tuple[Problem, ...] = ()


def read_document(path: Path) -> Document:
    """Read and parse a YAML file; raises ScenarioError (unreadable, too large, syntax, empty)."""
    try:
        text = read_text(path)
    except TextFileError as error:
        raise ScenarioError([Problem("", str(error))], str(path)) from error
    return parse_document(text, str(path))


def parse_document(text: str, source: str = "") -> Document:
    """Parse YAML text that holds one document; raises ScenarioError (syntax, empty)."""
    try:
        loader = yaml.SafeLoader(text)
        root = loader.get_single_node()
        outline = _Outline(root)
        value = None if root is None else loader.construct_document(root)
    except RecursionError:
        raise ScenarioError([Problem("", "is nested too deeply")], source) from None
    except _CONSTRUCTOR_ERRORS as error:
        raise ScenarioError([_syntax_problem(error)], source) from error
    if value is None:
        raise ScenarioError([Problem("", "is empty; see docs/parameters.md")], source)
    return Document(value, outline.lines, tuple(outline.duplicates))


def parse_value(text: str):
    """The plain value of a piece of YAML text; raises ValueError with the reason."""
    try:
        return yaml.safe_load(text)
    except RecursionError:
        raise ValueError("it is nested too deeply") from None
    except _CONSTRUCTOR_ERRORS as error:
        raise ValueError(_syntax_problem(error).message) from error


# What PyYAML says in words of Python.
_REASONS = {"found unhashable key": "a list or a section stands where a key is needed"}


def _syntax_problem(error: Exception) -> Problem:
    mark = getattr(error, "problem_mark", None)
    reason = getattr(error, "problem", None) or " ".join(str(error).split()) or "unknown value"
    reason = _REASONS.get(reason, reason)
    return Problem("", "is not valid YAML: {}".format(reason), line=mark and mark.line + 1)


class _Outline:
    """Walks a composed YAML document for the lines of its keys and its duplicate keys."""

    def __init__(self, root: Optional[yaml.Node]):
        self.lines: Dict[KeyPath, int] = {}
        self.duplicates = []
        self._visited = set()  # aliases make a node appear more than once, even inside itself
        if root is not None:
            self._walk(root, ())

    def _walk(self, node: yaml.Node, path: KeyPath) -> None:
        if id(node) in self._visited:
            return
        self._visited.add(id(node))
        if isinstance(node, yaml.MappingNode):
            self._walk_mapping(node, path)
        elif isinstance(node, yaml.SequenceNode):
            for index, item in enumerate(node.value):
                item_path = path + (str(index),)
                self.lines[item_path] = item.start_mark.line + 1
                self._walk(item, item_path)

    def _walk_mapping(self, node: yaml.MappingNode, path: KeyPath) -> None:
        first_lines: Dict[str, int] = {}
        for key, value in node.value:
            if not isinstance(key, yaml.ScalarNode) or key.tag == "tag:yaml.org,2002:merge":
                continue
            line = key.start_mark.line + 1
            key_path = path + (key.value,)
            if key.value in first_lines:
                message = "appears twice, first on line {}; remove one of the two".format(
                    first_lines[key.value]
                )
                self.duplicates.append(Problem(".".join(key_path), message, line=line))
            first_lines.setdefault(key.value, line)
            self.lines[key_path] = line
            self._walk(value, key_path)
