"""OctoMap's files: occupied, free and unknown cells."""

import functools
import os
import struct
from pathlib import Path
from typing import Dict, List, NamedTuple, Tuple

import numpy as np

from deformable_manipulation.mesh_formats.faces import FormatError
from deformable_manipulation.mesh_formats.numbers_in_text import shown
from deformable_manipulation.system.text_files import TextFileError, read_bytes

FORMATS = "OctoMap's .bt and .ot"
LARGEST_FILE = 1_000_000_000  # bytes
MOST_CELLS = 20_000_000
_DEPTH = 16  # of the finest cells in the tree
_MIDDLE = 1 << (_DEPTH - 1)  # index of the cell above the origin
_LONGEST_HEADER = 1 << 12  # bytes
_BINARY, _FULL = b"# Octomap OcTree binary file", b"# Octomap OcTree file"
# Bytes of a node, beside its float, by the kind of tree.
_EXTRAS = {"OcTree": 0, "ColorOcTree": 3}

_Leaf = Tuple[int, int, int, int]  # indices of its lowest cell, cells along a side


class OctomapError(ValueError):
    """A map cannot be read; the message says why, on one line."""


class Octomap(NamedTuple):
    """A map of cells; (i, j, k) reaches from size * (i, j, k) to size * (i + 1, j + 1, k + 1) [m].

    Cells that are neither occupied nor free are unknown.
    """

    size: float  # m
    occupied: np.ndarray  # (N, 3) int32
    free: np.ndarray  # (M, 3) int32


def read_octomap(path) -> Octomap:
    """Read a map. Nodes of .ot are occupied from a probability of 0.5 on, as OctoMap's default.

    Raises:
        OctomapError: the file, which it names, cannot be read, is no such map or broken, or has
            more than MOST_CELLS cells of the finest size.
    """
    try:
        status = os.stat(path)
        return _read(str(path), status.st_mtime_ns, status.st_size)
    except OSError as error:
        raise OctomapError("{} cannot be read: {}".format(path, error.strerror)) from error
    except TextFileError as error:
        raise OctomapError("{} {}".format(path, error)) from error
    except FormatError as error:
        raise OctomapError("{}: {}".format(path, error)) from error


@functools.lru_cache(maxsize=2)
def _read(path: str, _modified: int, _size: int) -> Octomap:
    suffix = Path(path).suffix.lower()
    data = read_bytes(path, LARGEST_FILE)
    if suffix not in (".bt", ".ot"):
        text = "'{}' is no format of maps that can be read; formats allowed: {}"
        raise FormatError(text.format(suffix, FORMATS))
    start = _BINARY if suffix == ".bt" else _FULL
    if not data.startswith(start):
        raise FormatError("it does not begin with the line {}".format(shown(start.decode())))
    lines, begin = _header(data)
    try:
        kind, size = lines["id"], float(lines["res"])
    except (KeyError, ValueError):
        raise FormatError("its header has no line 'id' or 'res' that can be understood") from None
    if kind not in _EXTRAS:
        raise FormatError("it holds a {}; allowed: {}".format(shown(kind), ", ".join(_EXTRAS)))
    if not 1e-6 <= size <= 1e3:
        raise FormatError("its cells are {:g} m large; allowed: 1e-6 to 1e3".format(size))
    try:
        if suffix == ".bt":
            occupied, free = _binary_leaves(data, begin)
        else:
            occupied, free = _full_leaves(data, begin, _EXTRAS[kind])
    except (IndexError, struct.error):
        raise FormatError("it is cut off") from None
    return Octomap(size, _cells(occupied), _cells(free))


def _header(data: bytes) -> Tuple[Dict[str, str], int]:
    """Words by the first word of their line, and where the nodes begin."""
    lines: Dict[str, str] = {}
    place = 0
    while True:
        end = data.find(b"\n", place, _LONGEST_HEADER)
        if end < 0:
            raise FormatError("its header has no end, a line 'data'")
        key, _, value = data[place:end].decode("latin-1").strip().partition(" ")
        place = end + 1
        if key == "data":
            return lines, place
        lines.setdefault(key, value.strip())


def _binary_leaves(data: bytes, place: int) -> Tuple[List[_Leaf], List[_Leaf]]:
    """Occupied and free leaves; two bits a child: 1 free, 2 occupied, 3 a node of its own."""
    found: Tuple[List[_Leaf], List[_Leaf]] = ([], [])
    nodes = [_ROOT] if len(data) > place else []
    while nodes:
        node = nodes.pop()
        states = data[place] | data[place + 1] << 8
        place += 2
        inner = []
        for child in range(8):
            state = states >> 2 * child & 3
            if state == 3:
                inner.append(_child(node, child))
            elif state:
                found[2 - state].append(_child(node, child))
        nodes += reversed(inner)
    return found


def _full_leaves(data: bytes, place: int, extra: int) -> Tuple[List[_Leaf], List[_Leaf]]:
    """Occupied and free leaves; a node is its log odds, more, and a bit for each child."""
    found: Tuple[List[_Leaf], List[_Leaf]] = ([], [])
    nodes = [_ROOT] if len(data) > place else []
    while nodes:
        node = nodes.pop()
        (log_odds,) = struct.unpack_from("<f", data, place)
        children = data[place + 4 + extra]
        place += 5 + extra
        if children:
            nodes += [_child(node, child) for child in range(7, -1, -1) if children >> child & 1]
        else:
            found[0 if log_odds >= 0.0 else 1].append(node)
    return found


_ROOT = (-_MIDDLE, -_MIDDLE, -_MIDDLE, 2 * _MIDDLE)


def _child(node: _Leaf, child: int) -> _Leaf:
    x, y, z, size = node
    half = size // 2
    if half == 0:
        raise FormatError("it is broken: its nodes are more than {} deep".format(_DEPTH))
    return (
        x + half * (child & 1),
        y + half * (child >> 1 & 1),
        z + half * (child >> 2),
        half,
    )


def _cells(leaves: List[_Leaf]) -> np.ndarray:
    """The finest cells (N, 3) in leaves of any size."""
    table = np.array(leaves, dtype=np.int64).reshape(-1, 4)
    count = int((table[:, 3] ** 3).sum())
    if count > MOST_CELLS:
        raise FormatError(
            "it has {} cells of the finest size, more than {}; make its cells larger, or cut out "
            "what is near the object".format(count, MOST_CELLS)
        )
    pieces = [np.zeros((0, 3), np.int32)]
    for size in np.unique(table[:, 3]).tolist():
        line = np.arange(size)
        within = np.stack(np.meshgrid(line, line, line), axis=-1).reshape(-1, 3)
        corners = table[table[:, 3] == size, :3]
        pieces.append((corners[:, None] + within).reshape(-1, 3).astype(np.int32))
    return np.concatenate(pieces)
