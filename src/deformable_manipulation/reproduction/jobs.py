"""Commands that run side by side, as many as there are cores, and what came of them."""

import time
from dataclasses import dataclass
from pathlib import Path
from typing import Callable, Iterable, List, Sequence, Tuple

from deformable_manipulation.interruption import check_interruption
from deformable_manipulation.ros.program import Program

_POLLING_PERIOD = 0.1  # s


@dataclass(frozen=True)
class Job:
    """A command, what it is called, and the exit statuses that are no failure."""

    title: str
    command: Tuple[str, ...]
    log: Path  # what it prints
    accepted: Tuple[int, ...] = (0,)


class JobFailed(RuntimeError):
    """A command ended otherwise than it should; the end of what it printed is in the text."""


def run_jobs(jobs: Iterable[Job], parallel: int, say: Callable[[str], None]) -> None:
    """Run all jobs, ``parallel`` at a time in their order, and tell of each that is done.

    Raises:
        JobFailed: a job failed; the others have been ended.
        deformable_manipulation.ros.program.ProgramError: one cannot be started.
    """
    waiting = list(jobs)
    total, done = len(waiting), 0
    running: List[Tuple[Job, Program, float]] = []
    try:
        while waiting or running:
            check_interruption()
            while waiting and len(running) < parallel:
                running.append(_start(waiting.pop(0)))
            ended = [entry for entry in running if entry[1].exit_status is not None]
            for entry in ended:
                running.remove(entry)
                done += 1
                _check(entry)
                job, _, started = entry
                say(f"{done} of {total}: {job.title}, {time.monotonic() - started:.0f} s")
            if not ended:
                time.sleep(_POLLING_PERIOD)
    finally:
        for _, program, _ in running:
            program.stop()


def _start(job: Job) -> Tuple[Job, Program, float]:
    return job, Program(job.title, job.command, job.log), time.monotonic()


def _check(entry: Sequence) -> None:
    job, program, _ = entry
    status = program.exit_status
    if status not in job.accepted:
        raise JobFailed(str(program.error(f"{job.title} ended with exit status {status}")))
