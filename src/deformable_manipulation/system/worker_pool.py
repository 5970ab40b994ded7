"""Processes of this machine that work side by side, and end with the command."""

import multiprocessing
import signal
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from typing import Any, Callable, Iterator, Optional


@contextmanager
def worker_pool(
    workers: int, prepare: Optional[Callable[..., None]] = None, *given: Any
) -> Iterator[ProcessPoolExecutor]:
    """A pool; whatever ends its use early, such as Ctrl-C, ends what its workers are at.

    Args:
        workers: their number.
        prepare: called once in each worker, with ``given``.
    """
    others = set(multiprocessing.active_children())
    # Not spawned: in a devel space a fresh interpreter that gets this one's path finds the sources
    # before the package with the compiled modules.
    context = multiprocessing.get_context("fork")
    pool = ProcessPoolExecutor(workers, context, _start, (prepare, given))
    try:
        yield pool
    except BaseException:
        for worker in set(multiprocessing.active_children()) - others:
            worker.terminate()
        raise
    finally:
        pool.shutdown(wait=True, cancel_futures=True)


def _start(prepare: Optional[Callable[..., None]], given) -> None:
    """Ctrl-C is the command's to answer, whose handlers were inherited."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    if prepare is not None:
        prepare(*given)
