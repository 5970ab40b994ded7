"""Who does the runs of a campaign: the cores of this machine, or a cluster.

A run depends on the campaign and its number alone, so it does not matter who does it, in which
order, or whether it is done again after its worker was lost. (Processors with other vector
instructions round differently; docs/safety.md.)
"""

import os
from concurrent.futures import as_completed
from concurrent.futures.process import BrokenProcessPool
from typing import Iterator, Sequence

from deformable_manipulation.campaign.outcome import RunOutcome
from deformable_manipulation.campaign.runs import Runs
from deformable_manipulation.system.worker_pool import worker_pool

_TRIES = 3  # of a run whose workers are lost
_PATIENCE = 60.0  # s, until a cluster's first worker has come


class WorkersLost(RuntimeError):
    """Runs could not be done: their workers ended again and again, or none came."""


def run_here(campaign: Runs, indices: Sequence[int], workers: int) -> Iterator[RunOutcome]:
    """Do runs in processes of this machine; yields the outcomes as they come.

    A worker that is killed takes its pool with it: the runs that have no outcome yet are done again
    in a new one.

    Raises:
        WorkersLost: they ended again and again.
    """
    open_runs = set(indices)
    for _ in range(_TRIES):
        try:
            for outcome in _in_one_pool(campaign, sorted(open_runs), workers):
                open_runs.discard(outcome.index)
                yield outcome
            return
        except BrokenProcessPool:
            continue
    raise WorkersLost(
        f"workers ended {_TRIES} times, perhaps for lack of memory; {len(open_runs)} runs "
        f"are not done, the first of them {min(open_runs)}. Try fewer --workers"
    )


def _in_one_pool(campaign, indices, workers) -> Iterator[RunOutcome]:
    with worker_pool(workers, _start_worker, campaign) as pool:
        futures = [pool.submit(_run, index) for index in indices]
        for future in as_completed(futures):
            yield future.result()


_campaign: Runs  # of this worker process


def _start_worker(campaign: Runs) -> None:
    global _campaign
    _campaign = campaign


def _run(index: int) -> RunOutcome:
    return _campaign.run(index)


def run_on_cluster(campaign: Runs, indices: Sequence[int], address: str) -> Iterator[RunOutcome]:
    """Do runs on the workers of a Dask scheduler; yields the outcomes as they come.

    Waits for a first worker; others may come and go. Dask gives the runs of a lost worker to
    another one. The workers need this package.

    Raises:
        WorkersLost: they ended again and again, or none came.
        OSError: the scheduler cannot be reached.
    """
    from dask import distributed  # optional

    with distributed.Client(address, timeout=10) as client:
        _await_worker(client, address)
        shared = client.scatter(campaign, broadcast=True)
        futures = client.map(type(campaign).run, [shared] * len(indices), indices, pure=False)
        for future in distributed.as_completed(futures):
            if future.status == "error" and isinstance(
                future.exception(), distributed.KilledWorker
            ):
                raise WorkersLost(
                    f"a run was given to several workers and all of them ended: "
                    f"{future.exception()}"
                )
            yield future.result()


def _await_worker(client, address: str) -> None:
    from dask import distributed

    try:
        client.wait_for_workers(1, timeout=_PATIENCE)
    except distributed.TimeoutError:
        raise WorkersLost(
            f"no worker connected to the scheduler at {address} within {_PATIENCE:g} s; start some "
            f"on machines with this package: dask worker {address}"
        ) from None


def cores() -> int:
    """How many cores this process may use."""
    return len(os.sched_getaffinity(0))
