"""How commands end when they are asked to: by Ctrl-C or by a signal."""

import contextlib
import signal
import threading
from typing import Iterator, List

INTERRUPTED = 128 + signal.SIGINT  # exit status
TERMINATED = 128 + signal.SIGTERM

_pending: List[type] = []
_contexts: list = []  # of interruptible() that have not ended


class Terminated(KeyboardInterrupt):
    """The process was asked to end by SIGTERM."""


def exit_status(interrupt: KeyboardInterrupt) -> int:
    """The exit status of a command that was interrupted."""
    return TERMINATED if isinstance(interrupt, Terminated) else INTERRUPTED


def check_interruption() -> None:
    """Raise again what was raised when the process was asked to end.

    Libraries that catch everything would keep it from the command.
    """
    if _pending:
        raise _pending[-1]


@contextlib.contextmanager
def interruptible() -> Iterator[None]:
    """SIGTERM (a batch system's or timeout's) ends the command as Ctrl-C does.

    What was raised is forgotten at the end of the outermost of these contexts.
    """
    outermost = not _contexts

    def interrupt(number, frame):
        _pending.append(Terminated if number == signal.SIGTERM else KeyboardInterrupt)
        check_interruption()

    with _signal_handler(signal.SIGINT, interrupt), _signal_handler(signal.SIGTERM, interrupt):
        _contexts.append(interrupt)
        try:
            yield
        finally:
            _contexts.pop()
            if outermost:
                _pending.clear()


@contextlib.contextmanager
def interrupts_ignored() -> Iterator[None]:
    """A second, impatient Ctrl-C must not cut short what is done at the end."""
    with _signal_handler(signal.SIGINT, signal.SIG_IGN):
        with _signal_handler(signal.SIGTERM, signal.SIG_IGN):
            yield


@contextlib.contextmanager
def _signal_handler(number: int, handler) -> Iterator[None]:
    # Only the main thread may set handlers; elsewhere no signal reaches this code anyway.
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    previous = signal.signal(number, handler)
    try:
        yield
    finally:
        signal.signal(number, previous)
