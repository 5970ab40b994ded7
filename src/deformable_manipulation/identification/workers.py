"""Replays of several windows at a time, in processes of this machine."""

from contextlib import contextmanager
from typing import Callable, Iterator

from deformable_manipulation.system.worker_pool import worker_pool


@contextmanager
def worker_map(workers: int) -> Iterator[Callable]:
    """A function like ``map`` whose calls run in processes; the built-in one for a single worker.

    Raises:
        BrokenProcessPool: from the function, if a worker was killed.
    """
    if workers < 2:
        yield map
        return
    with worker_pool(workers) as pool:
        yield pool.map
