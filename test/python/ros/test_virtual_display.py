import struct

import numpy as np
import pytest

from deformable_manipulation.ros.virtual_display import read_window_dump
from deformable_manipulation.system.program import ProgramError

NAME = b"screen\0\0"


def window_dump(pixels, order="<", padding=3, version=7, bits=32, colors=5):
    """An X window dump of pixels (height, width, 3), with columns of padding and a color map."""
    height, width, _ = pixels.shape
    line = 4 * (width + padding)
    fields = [100 + len(NAME), version, 2, 24, width, height, 0, int(order == ">"), 32, 0, 32, bits]
    fields += [line, 4, 0xFF0000, 0xFF00, 0xFF, 8, 256, colors, width, height, 0, 0, 0]
    red, green, blue = np.moveaxis(pixels.astype(np.uint32), 2, 0)
    rows = np.full((height, width + padding), 0xFFFFFFFF, order + "u4")
    rows[:, :width] = 0x7F000000 | red << 16 | green << 8 | blue
    return struct.pack(">25I", *fields) + NAME + bytes(12 * colors) + rows.tobytes()


@pytest.fixture
def pixels():
    return np.random.default_rng(7).integers(0, 256, (6, 9, 3), dtype=np.uint8)


@pytest.mark.parametrize("order", ["<", ">"])
def test_a_window_dump_gives_the_pixels(pixels, order):
    read = read_window_dump(window_dump(pixels, order))
    assert read.dtype == np.uint8
    np.testing.assert_array_equal(read, pixels)


def test_more_than_the_picture_does_not_matter(pixels):
    np.testing.assert_array_equal(read_window_dump(window_dump(pixels) + bytes(100)), pixels)


@pytest.mark.parametrize("length", [0, 50, 120, -1])
def test_a_window_dump_that_is_cut_off(pixels, length):
    with pytest.raises(ProgramError, match="truncated"):
        read_window_dump(window_dump(pixels)[:length])


@pytest.mark.parametrize("change", [{"version": 6}, {"bits": 16}])
def test_another_kind_of_window_dump(pixels, change):
    with pytest.raises(ProgramError, match="expected version 7 and 32 bits"):
        read_window_dump(window_dump(pixels, **change))
