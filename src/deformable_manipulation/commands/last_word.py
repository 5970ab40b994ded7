"""Says something after the program that started this one has said all it has to say."""

import os
import sys
import time
from pathlib import Path

_PATIENCE = 10.0  # s, for a program that goes on
_POLLING_PERIOD = 0.02  # s


def say_after_parent(text: str) -> None:
    """Print to stderr when the parent process has ended, from a process of its own.

    roslaunch follows what a command of a launch file prints with long lines of its own, in which
    the reason for the failure gets lost.

    Args:
        text: printed on a line of its own.
    """
    parent = os.getppid()
    sys.stdout.flush()
    if os.fork():
        return
    try:
        _leave_input_and_output()
        deadline = time.monotonic() + _PATIENCE
        while _is_running(parent) and time.monotonic() < deadline:
            time.sleep(_POLLING_PERIOD)
        os.write(2, "{}\n".format(text).encode(sys.stderr.encoding or "utf-8", "replace"))
    finally:
        os._exit(0)


def _leave_input_and_output() -> None:
    """The parent waits for the end of the output, and Ctrl-C is for the parent."""
    os.setsid()
    nowhere = os.open(os.devnull, os.O_RDWR)
    os.dup2(nowhere, 0)
    os.dup2(nowhere, 1)


def _is_running(process: int) -> bool:
    """Whether a process is there and has not ended; who started it may not have noticed yet."""
    try:
        status = Path("/proc/{}/stat".format(process)).read_text()
    except OSError:
        return False
    return status.rpartition(")")[2].split()[0] not in "ZX"
