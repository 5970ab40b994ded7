"""Workers end with the command, whatever they are at."""

import multiprocessing
import os
import signal
import subprocess
import sys
import time

import pytest

from deformable_manipulation.system.worker_pool import worker_pool

# A command whose workers are at long work, and that is told when they are at it.
COMMAND = r"""
import os, sys, time
from deformable_manipulation.system.interruption import exit_status, interruptible
from deformable_manipulation.system.worker_pool import worker_pool

def work(number):
    os.write(1, b"working\n")
    time.sleep(600)

with interruptible():
    try:
        with worker_pool(2) as pool:
            for future in [pool.submit(work, number) for number in range(6)]:
                future.result()
    except KeyboardInterrupt as interrupt:
        sys.exit(exit_status(interrupt))
"""


def _prepare(value):
    os.environ["PREPARED"] = value


def test_work_is_done_by_prepared_workers():
    with worker_pool(2, _prepare, "yes") as pool:
        assert set(pool.map(os.getenv, ["PREPARED"] * 4)) == {"yes"}


def test_a_mistake_ends_what_is_under_way():
    started = time.monotonic()
    with pytest.raises(ValueError):
        with worker_pool(1) as pool:
            pool.submit(time.sleep, 600.0)
            raise ValueError
    assert time.monotonic() - started < 60.0
    assert not multiprocessing.active_children()


@pytest.mark.parametrize("number, status", [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
@pytest.mark.parametrize("everybody", [False, True])
def test_a_signal_ends_a_command_and_its_workers(number, status, everybody):
    """Sent to the command, or as by a terminal and by timeout to all of its processes."""
    command = subprocess.Popen(
        [sys.executable, "-c", COMMAND], stdout=subprocess.PIPE, start_new_session=True
    )
    for _ in range(2):
        assert command.stdout.readline() == b"working\n"
    (os.killpg if everybody else os.kill)(command.pid, number)
    try:
        assert command.wait(60.0) == status
    finally:
        try:
            os.killpg(command.pid, signal.SIGKILL)
        except ProcessLookupError:
            return
    pytest.fail("a worker was left")
