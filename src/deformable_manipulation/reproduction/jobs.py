"""Commands that run side by side, as many as there are cores, and what came of them."""

import os
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Iterable, List, Tuple

from deformable_manipulation.reproduction.display import JobDisplay, Running
from deformable_manipulation.system.interruption import check_interruption
from deformable_manipulation.system.program import Program

_POLLING_PERIOD = 0.1  # s
_TAIL = 300  # bytes of a log that hold its last line


@dataclass(frozen=True)
class Job:
    """A command, what it is called, and the exit statuses that are no failure."""

    title: str
    command: Tuple[str, ...]
    log: Path  # what it prints
    accepted: Tuple[int, ...] = (0,)


class JobFailed(RuntimeError):
    """A command ended otherwise than it should; the end of what it printed is in the text."""


def run_jobs(jobs: Iterable[Job], parallel: int, display: JobDisplay) -> None:
    """Run all jobs, ``parallel`` at a time in their order; the display tells how far they are.

    Raises:
        JobFailed: a job failed; the others have been ended.
        deformable_manipulation.system.program.ProgramError: one cannot be started.
    """
    waiting = list(jobs)
    running: List[_RunningJob] = []
    try:
        while waiting or running:
            check_interruption()
            while waiting and len(running) < parallel:
                job = waiting.pop(0)
                running.append(_RunningJob(job, Program(job.title, job.command, job.log)))
            ended = [each for each in running if each.program.exit_status is not None]
            for each in ended:
                running.remove(each)
                each.check()
                display.done(each.job.title, each.seconds)
            display.running([each.status() for each in running])
            if not ended:
                time.sleep(_POLLING_PERIOD)
    finally:
        display.close()
        for each in running:
            each.program.stop()


@dataclass(frozen=True)
class _RunningJob:
    job: Job
    program: Program
    started: float = field(default_factory=time.monotonic)

    @property
    def seconds(self) -> float:
        return time.monotonic() - self.started

    def status(self) -> Running:
        return Running(self.job.title, self.seconds, _last_line(self.job.log))

    def check(self) -> None:
        status = self.program.exit_status
        if status not in self.job.accepted:
            title = self.job.title
            raise JobFailed(str(self.program.error(f"{title} ended with exit status {status}")))


def _last_line(log: Path) -> str:
    """What a command has printed last; empty: nothing yet."""
    with open(str(log), "rb") as file:
        file.seek(max(file.seek(0, os.SEEK_END) - _TAIL, 0))
        lines = file.read().decode("utf-8", "replace").split("\n")
    return next((line.strip() for line in reversed(lines) if line.strip()), "")
