"""Replays of several windows at a time, in processes of this machine."""

import multiprocessing
import signal
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from typing import Callable, Iterator


@contextmanager
def worker_map(workers: int) -> Iterator[Callable]:
    """A function like ``map`` whose calls run in processes; the built-in one for a single worker.

    Raises:
        BrokenProcessPool: from the function, if a worker was killed.
    """
    if workers < 2:
        yield map
        return
    # Not spawned: in a devel space a fresh interpreter that gets this one's path finds the sources
    # before the package with the compiled modules.
    pool = ProcessPoolExecutor(workers, multiprocessing.get_context("fork"), _start_worker)
    try:
        yield pool.map
    finally:
        pool.shutdown(wait=True, cancel_futures=True)


def _start_worker() -> None:
    """Ctrl-C is the command's to answer."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
