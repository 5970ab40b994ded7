"""How far a run is, shown on a terminal or in a log."""

from typing import TextIO

WIDTH = 40  # characters of the bar
LOG_STEP = 10  # percent between lines where there is no terminal


class ProgressDisplay:
    """A bar that redraws itself on a terminal; elsewhere a line every ten percent.

    Call it with the fraction done, 0 to 1; ``close`` ends the bar's line.
    """

    def __init__(self, stream: TextIO):
        self._stream = stream
        self._terminal = stream.isatty()
        self._percent = -1
        self._open = False

    def __call__(self, fraction: float) -> None:
        percent = int(100 * min(max(fraction, 0.0), 1.0))
        if self._terminal:
            self._draw(percent)
        elif percent // LOG_STEP > max(self._percent, 0) // LOG_STEP:
            self._stream.write(f"{percent:3d} %\n")
            self._stream.flush()
        self._percent = percent

    def close(self) -> None:
        """Leave the bar as it stands and go to the next line."""
        if self._open:
            self._stream.write("\n")
            self._stream.flush()
            self._open = False

    def _draw(self, percent: int) -> None:
        if percent == self._percent:
            return
        done = WIDTH * percent // 100
        self._stream.write("\r[{}{}] {:3d} %".format("#" * done, "." * (WIDTH - done), percent))
        self._stream.flush()
        self._open = True
