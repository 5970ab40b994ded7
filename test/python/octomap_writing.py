"""OctoMap's files, written as the format says."""

import struct


class Tree:
    """Cells of a map: None unknown, False free, True occupied; of the finest size or larger."""

    def __init__(self):
        self.children = {}
        self.state = None

    def set(self, cell, state, depth=16):
        """Set a cell of this depth, by the indices of its lowest finest cell."""
        node, place = self, [index + (1 << 15) for index in cell]
        for level in range(15, 15 - depth, -1):
            child = sum((place[axis] >> level & 1) << axis for axis in range(3))
            node = node.children.setdefault(child, Tree())
        node.state = state

    def binary(self):
        """Its nodes as .bt holds them."""
        states = 0
        for child, node in self.children.items():
            state = 3 if node.children else (2 if node.state else 1)
            states |= state << 2 * child
        inner = [self.children[child] for child in sorted(self.children)]
        below = b"".join(node.binary() for node in inner if node.children)
        return struct.pack("<H", states) + below

    def full(self, extra=b""):
        """Its nodes as .ot holds them."""
        log_odds = {None: 0.0, True: 0.85, False: -0.4}[self.state]
        mask = sum(1 << child for child in self.children)
        below = [self.children[child].full(extra) for child in sorted(self.children)]
        return struct.pack("<f", log_odds) + extra + bytes([mask]) + b"".join(below)


def bt(tree, size=0.1, **lines):
    """A .bt file."""
    return _file("# Octomap OcTree binary file", size, lines) + tree.binary()


def ot(tree, size=0.1, extra=b"", **lines):
    """A .ot file."""
    return _file("# Octomap OcTree file", size, lines) + tree.full(extra)


def _file(first, size, lines):
    words = {"id": "OcTree", "size": 1, "res": size, **lines}
    return "\n".join([first, "#", *map("{0[0]} {0[1]}".format, words.items()), "data\n"]).encode()
