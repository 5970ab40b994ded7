"""Files that the scenario names."""

import os
from typing import Any, Callable

from deformable_manipulation.reading.readers import Node
from deformable_manipulation.system.package_files import resolve_file


class CheckedFile:
    """The name of a file; returns its absolute path.

    The file is read, so that what is wrong with it is found together with all other mistakes,
    unless that has been done before (:attr:`Node.files_are_read`).

    Args:
        allowed: what file it is, in words.
        read: reads the file of a path, which the node names. Raises ValueError.
    """

    type, unit, range = "file", "", ""

    def __init__(self, allowed: str, read: Callable[[str, Node], Any]):
        self.allowed = allowed
        self._read = read

    def __call__(self, node: Node) -> str:
        if not isinstance(node.value, str) or not node.value:
            node.fail("must be {}".format(self.allowed))
        if node.files_are_read:
            return node.value
        try:
            path = os.path.abspath(str(resolve_file(node.value, node.directory)))
            self._read(path, node)
        except (ValueError, FileNotFoundError) as error:
            node.fail(str(error))
        return path
