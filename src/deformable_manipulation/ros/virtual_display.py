"""A screen without a monitor, and what is on it."""

import contextlib
import os
from pathlib import Path

import numpy as np

from deformable_manipulation.system.program import Program, ProgramError

_TIMEOUT = 30.0  # s, for the X server to be ready

# The X window dump begins with these numbers of 32 bits, the most significant byte first.
_XWD_FIELDS = (
    "header_size version pixmap_format depth width height x_offset byte_order bitmap_unit "
    "bitmap_bit_order bitmap_pad bits_per_pixel bytes_per_line visual_class red_mask green_mask "
    "blue_mask bits_per_color colormap_entries colors"
).split()
_XWD_VERSION = 7
_XWD_COLOR_SIZE = 12  # bytes, an entry of the color map
_LEAST_SIGNIFICANT_FIRST = 0

# Of the screen that the command itself was started from.
_OTHER_SCREENS = ("WAYLAND_DISPLAY", "XAUTHORITY", "QT_SCALE_FACTOR", "QT_SCREEN_SCALE_FACTORS")


@contextlib.contextmanager
def virtual_display(size, directory):
    """An X server (Xvfb) that draws into memory, for the time of a with statement.

    Args:
        size: width and height in pixels.
        directory: existing folder for its files.

    Yields:
        VirtualDisplay

    Raises:
        ProgramError: it does not start.
    """
    reading, writing = os.pipe()
    os.set_blocking(reading, False)
    # The server chooses a free display number and writes it when it is ready.
    command = ["Xvfb", "-displayfd", str(writing), "-fbdir", str(directory), "-screen", "0"]
    command += ["{}x{}x24".format(*size), "-nolisten", "tcp", "-noreset", "-nocursor"]
    log = Path(directory) / "xvfb.log"
    with open(reading, "rb") as answer, open(writing, "wb"):
        with Program("Xvfb", command, log, pass_fds=(writing,)) as server:
            number = server.wait_until(answer.read, _TIMEOUT, "Xvfb was not ready yet")
            name = ":" + number.decode().strip()
            yield VirtualDisplay(name, Path(directory) / "Xvfb_screen0")


class VirtualDisplay:
    """A screen in memory.

    Args:
        name: as programs know it, such as ``:1``.
        frame: file with the picture, an X window dump.
    """

    def __init__(self, name, frame):
        self.name = name
        self._frame = frame

    def environment(self):
        """This process's environment for a program on this display, with OpenGL in software."""
        environment = {key: value for key, value in os.environ.items() if key not in _OTHER_SCREENS}
        environment.update(DISPLAY=self.name, QT_QPA_PLATFORM="xcb", LIBGL_ALWAYS_SOFTWARE="1")
        return environment

    def pixels(self):
        """What is on the screen, (height, width, 3) red, green, blue of 0 to 255."""
        return read_window_dump(self._frame.read_bytes())


def read_window_dump(data):
    """Pixels (height, width, 3), uint8, of an X window dump (XWD) with 32 bits a pixel.

    Raises:
        ProgramError: it is something else, or cut off.
    """
    count = len(_XWD_FIELDS)
    if len(data) < 4 * count:
        raise ProgramError(f"The screen's window dump is truncated: {len(data)} bytes")
    header = dict(zip(_XWD_FIELDS, np.frombuffer(data, ">u4", count).tolist()))
    if header["version"] != _XWD_VERSION or header["bits_per_pixel"] != 32:
        raise ProgramError(
            "The screen's window dump has version {version} and {bits_per_pixel} bits per pixel; "
            "expected version 7 and 32 bits".format(**header)
        )
    start = header["header_size"] + _XWD_COLOR_SIZE * header["colors"]
    height, line = header["height"], header["bytes_per_line"]
    if len(data) < start + height * line:
        raise ProgramError(f"The screen's window dump is truncated: {len(data)} bytes")
    kind = "<u4" if header["byte_order"] == _LEAST_SIGNIFICANT_FIRST else ">u4"
    rows = np.frombuffer(data, kind, height * line // 4, start).reshape(height, -1)
    values = rows[:, : header["width"]].astype(np.uint32)
    masks = (header[f"{color}_mask"] for color in ("red", "green", "blue"))
    return np.stack([_channel(values, mask) for mask in masks], axis=2)


def _channel(values, mask):
    lowest_bit = mask & -mask
    return ((values & mask) // lowest_bit).astype(np.uint8)
