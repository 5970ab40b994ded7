"""OctoMap's files."""

import numpy as np
import pytest
from octomap_writing import Tree, bt, ot

from deformable_manipulation.geometry import octomap_files
from deformable_manipulation.geometry.octomap_files import OctomapError, read_octomap

OCCUPIED = [(0, 0, 0), (-1, 5, 7), (-32768, -32768, -32768), (32767, 32767, 32767)]
FREE = [(1, 0, 0), (100, -200, 3)]


@pytest.fixture
def tree():
    tree = Tree()
    for cell in OCCUPIED:
        tree.set(cell, True)
    for cell in FREE:
        tree.set(cell, False)
    return tree


@pytest.fixture
def read(tmp_path):
    def read_bytes(data, name="map.bt"):
        (tmp_path / name).write_bytes(data)
        octomap_files._read.cache_clear()
        return read_octomap(tmp_path / name)

    return read_bytes


def cells(array):
    return sorted(map(tuple, array.tolist()))


def test_both_formats(tree, read):
    for name, data in (("map.bt", bt(tree, 0.05)), ("map.ot", ot(tree, 0.05))):
        found = read(data, name)
        assert found.size == 0.05 and found.occupied.dtype == np.int32
        assert (cells(found.occupied), cells(found.free)) == (sorted(OCCUPIED), sorted(FREE))


def test_trees_with_colours(tree, read):
    found = read(ot(tree, extra=b"\xff\x00\x80", id="ColorOcTree"), "map.ot")
    assert cells(found.occupied) == sorted(OCCUPIED)


def test_large_leaves_are_divided(read):
    tree = Tree()
    tree.set((8, -16, 0), True, depth=14)
    tree.set((100, 100, 100), False)
    for name, data in (("map.bt", bt(tree)), ("map.ot", ot(tree))):
        found = read(data, name)
        expected = [(8 + i, -16 + j, k) for i in range(4) for j in range(4) for k in range(4)]
        assert cells(found.occupied) == expected and cells(found.free) == [(100, 100, 100)]


@pytest.mark.parametrize("write", [bt, ot])
def test_every_file_that_is_cut_off_is_told(write, tree, read):
    name = "map." + write.__name__
    data = write(tree)
    begin = data.index(b"data\n") + 5
    for end in [*range(begin + 1, len(data)), *range(1, begin, 7)]:
        with pytest.raises(OctomapError, match=name):
            read(data[:end], name)


@pytest.mark.parametrize(
    "data, name, told",
    [
        (b"anything", "map.bt", "does not begin with the line '# Octomap OcTree binary file'"),
        (bt(Tree()), "map.ot", "does not begin with the line '# Octomap OcTree file'"),
        (ot(Tree(), id="OcTreeStamped"), "map.ot", "it holds a 'OcTreeStamped'; allowed: OcTree"),
        (bt(Tree(), res="small"), "map.bt", "no line 'id' or 'res' that can be understood"),
        (bt(Tree(), res=0.0), "map.bt", "its cells are 0 m large"),
        (b"# Octomap OcTree binary file\nid OcTree\n", "map.bt", "no end, a line 'data'"),
        (b"x", "map.pcd", "'.pcd' is no format of maps that can be read"),
    ],
)
def test_files_that_are_wrong(data, name, told, read):
    with pytest.raises(OctomapError, match=told):
        read(data, name)


def test_a_tree_that_is_too_deep(read):
    deep = b"\x03\x00" * 40
    with pytest.raises(OctomapError, match="more than 16 deep"):
        read(bt(Tree())[:-2] + deep)


def test_maps_that_are_too_large_are_not_divided(read, monkeypatch):
    tree = Tree()
    tree.set((0, 0, 0), True, depth=1)
    with pytest.raises(OctomapError, match="35184372088832 cells of the finest size, more than"):
        read(bt(tree))


def test_no_file(tmp_path):
    with pytest.raises(OctomapError, match="cannot be read: No such file"):
        read_octomap(tmp_path / "map.bt")
    with pytest.raises(OctomapError):
        read_octomap(tmp_path)
