"""An OctoMap file of a scenario's obstacles, as a robot would have made it that saw all of them."""

import struct

import numpy as np
from output_folder import output_folder

from deformable_manipulation import load_scenario
from deformable_manipulation.distance.minimum_distance import MinimumDistance
from deformable_manipulation.obstacles.spec import obstacle_corners

LEVELS = 16  # of an octree of OctoMap
SIZE = 0.05  # m, of a cell


def main():
    """Write the map of fabric_over_octomap, which its controllers know its obstacles by."""
    folder = output_folder(__doc__)
    obstacles = [each for each in load_scenario("fabric_over_octomap").obstacles if not each.known]
    cells = occupied(obstacles, SIZE)
    (folder / "machine.bt").write_bytes(heading(SIZE) + node(codes_of(cells), LEVELS))
    print("{} cells of {} m in machine.bt".format(len(cells), SIZE))


def occupied(obstacles, size):
    """Indices (N, 3) of the cells that reach into an obstacle, or nearly."""
    corners = np.concatenate([obstacle_corners(each) for each in obstacles])
    low, high = np.floor(corners.min(axis=0) / size), np.ceil(corners.max(axis=0) / size)
    lines = [np.arange(first - 1, last + 1) for first, last in zip(low, high)]
    cells = np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1).reshape(-1, 3).astype(int)
    middles = size * (cells + 0.5)
    # Each middle as a copy of an object that is nowhere else.
    distances = MinimumDistance(obstacles, 0.0).compute(np.repeat(middles[:, None], 2, axis=1))
    return cells[np.asarray(distances.minimum) < 0.5 * np.sqrt(3.0) * size]


def codes_of(cells):
    """Places (N,) of cells in the octree, sorted: three bits a level, x lowest."""
    shifted = cells + (1 << LEVELS - 1)
    codes = np.zeros(len(cells), dtype=np.int64)
    for level in range(LEVELS):
        for axis in range(3):
            codes |= (shifted[:, axis] >> level & 1) << 3 * level + axis
    return np.sort(codes)


def node(codes, level):
    """An inner node as a .bt file holds it, with all below it.

    Args:
        codes: sorted, of the occupied cells in it.
        level: how many levels of cells are below it.
    """
    children = codes >> 3 * (level - 1) & 7
    states, below = 0, b""
    for child in range(8):
        inside = codes[children == child]
        if len(inside) == 8 ** (level - 1):  # all of it is occupied
            states |= 2 << 2 * child
        elif len(inside):
            states |= 3 << 2 * child
            below += node(inside, level - 1)
    return struct.pack("<H", states) + below


def heading(size):
    """The first lines of the file."""
    lines = ["# Octomap OcTree binary file", "id OcTree", "size 1", "res {}".format(size), "data"]
    return "".join(line + "\n" for line in lines).encode()


if __name__ == "__main__":
    main()
