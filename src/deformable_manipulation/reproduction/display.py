"""How far jobs are, shown on a terminal or in a log."""

import shutil
import time
from typing import NamedTuple, Sequence, TextIO

_LOG_PERIOD = 15.0  # s between lines about what is running, where there is no terminal
_CLEAR = "\r\x1b[K"


class Running(NamedTuple):
    """A job that is running."""

    title: str
    seconds: float  # since it was started
    last: str  # what it printed last


class JobDisplay:
    """A line for each job that is done, and what is running.

    On a terminal a line that redraws itself tells what is running, elsewhere a line now and then.

    Args:
        name: of the command.
        total: number of jobs.
    """

    def __init__(self, name: str, total: int, stream: TextIO):
        self._name = name
        self._total = total
        self._stream = stream
        self._terminal = stream.isatty()
        self._done = 0
        self._drawn = ""
        self._told = time.monotonic()

    def done(self, title: str, seconds: float) -> None:
        """Tell that a job is done, after this time [s]."""
        self._done += 1
        self._tell(f"{self._done} of {self._total}: {title}, {seconds:.0f} s")

    def running(self, jobs: Sequence[Running]) -> None:
        """Tell of all jobs that are running, if there is something new."""
        text = "; ".join(_describe(job) for job in jobs)
        if self._terminal:
            self._draw(text)
        elif jobs and time.monotonic() - self._told >= _LOG_PERIOD:
            self._tell(f"running: {text}")

    def close(self) -> None:
        """Leave nothing on the terminal's line."""
        self._draw("")

    def _tell(self, text: str) -> None:
        self._draw("")
        self._told = time.monotonic()
        self._stream.write(f"{self._name}: {text}\n")
        self._stream.flush()

    def _draw(self, text: str) -> None:
        text = text[: shutil.get_terminal_size().columns - 1]
        if text == self._drawn:
            return
        self._drawn = text
        self._stream.write(_CLEAR + text)
        self._stream.flush()


def _describe(job: Running) -> str:
    last = f", {job.last}" if job.last else ""
    return f"{job.title} ({job.seconds:.0f} s{last})"
