"""Replacing values in YAML text, so that comments and order stay as they are."""

import math
import re
from typing import Dict, Iterator, Mapping, Tuple

import yaml

KeyPath = Tuple[str, ...]

_PLAIN = re.compile(r"[A-Za-z./_$][A-Za-z0-9./_$:+-]*[A-Za-z0-9/_]")  # needs no quotes


def scalars(text: str) -> Dict[KeyPath, str]:
    """The text of every plain value, by its key path; items of lists go by their index.

    Raises:
        yaml.YAMLError: the text is no YAML.
    """
    root = yaml.compose(text, Loader=yaml.SafeLoader)
    return {} if root is None else {path: node.value for path, node in _walk(root, ())}


def replace_scalars(text: str, values: Mapping[KeyPath, str]) -> str:
    """The YAML text with other texts for some of its plain values; paths not in it are passed over.

    Raises:
        yaml.YAMLError: the text is no YAML.
    """
    root = yaml.compose(text, Loader=yaml.SafeLoader)
    if root is None:
        return text
    spans = {
        (node.start_mark.index, node.end_mark.index): values[path]
        for path, node in _walk(root, ())
        if path in values
    }
    for (start, end), value in sorted(spans.items(), reverse=True):
        text = text[:start] + _quoted(value) + text[end:]
    return text


def _walk(node: yaml.Node, path: KeyPath) -> Iterator[Tuple[KeyPath, yaml.ScalarNode]]:
    if isinstance(node, yaml.ScalarNode):
        yield path, node
    elif isinstance(node, yaml.MappingNode):
        for key, item in node.value:
            if isinstance(key, yaml.ScalarNode):
                yield from _walk(item, path + (key.value,))
    else:
        for index, item in enumerate(node.value):
            yield from _walk(item, path + (str(index),))


def _quoted(value: str) -> str:
    """The text as a YAML string on one line, in quotes where it needs them."""
    if _PLAIN.fullmatch(value) and isinstance(yaml.safe_load(value), str):
        return value
    quoted = yaml.safe_dump(value, default_style='"', allow_unicode=True, width=math.inf)
    return quoted.rstrip("\n")
