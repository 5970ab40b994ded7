"""Programs that a command starts and ends again, whatever happens to it."""

import os
import re
import signal
import subprocess
import time

from deformable_manipulation.system.interruption import check_interruption

_POLLING_PERIOD = 0.05  # s
# roslaunch gives its nodes 15 s before it becomes insistent.
_PATIENCE = 40.0  # s, from the request to end until the end is forced
_LOG_LINES = 15
_COLORS = re.compile(r"\x1b\[[0-9;]*m|\x1b\].*?\x07")  # a terminal's, and its window title


class ProgramError(RuntimeError):
    """A program that was started does not do what it was started for."""


class ProgramCrashed(ProgramError):
    """A program was ended by a signal that nobody here sent."""


class Program:
    """A running program; as a context manager it is ended on leaving.

    It has a session of its own, so that Ctrl-C on the terminal reaches the command alone, which
    then ends its programs in order. It is ended, too, when the command is killed.

    Args:
        name: for messages.
        command: program and arguments.
        log: file for all it prints.
        environment: its environment; default: this process's.
        pass_fds: file descriptors that it keeps.

    Raises:
        ProgramError: it cannot be started.
    """

    def __init__(self, name, command, log, environment=None, pass_fds=()):
        self.name = name
        self._log = log
        with open(str(log), "wb") as output:
            try:
                self._process = subprocess.Popen(
                    ["setpriv", "--pdeathsig", "TERM", *command],
                    env=environment,
                    stdin=subprocess.DEVNULL,
                    stdout=output,
                    stderr=subprocess.STDOUT,
                    start_new_session=True,
                    pass_fds=pass_fds,
                )
            except OSError as error:
                raise ProgramError(f"{name} cannot be started: {error}") from error

    @property
    def pid(self):
        """Its process id."""
        return self._process.pid

    @property
    def exit_status(self):
        """None while it runs; negative: the signal that ended it."""
        return self._process.poll()

    def check(self):
        """Raise ProgramError, or ProgramCrashed, if the program has ended by itself."""
        status = self._process.poll()
        if status is None:
            return
        if status < 0:
            raise self.error(f"{self.name} was ended by signal {-status}", ProgramCrashed)
        raise self.error(f"{self.name} ended with exit status {status}")

    def error(self, message, kind=ProgramError):
        """A ProgramError, or another kind of it, with the end of what the program printed."""
        with open(str(self._log), errors="replace") as log:
            lines = _COLORS.sub("", log.read()).strip().splitlines()[-_LOG_LINES:]
        printed = "\n  ".join([f"Last output of {self.name}:"] + lines)
        return kind(f"{message}.\n{printed}" if lines else f"{message}.")

    def wait_until(self, condition, timeout, complaint, period=_POLLING_PERIOD):
        """Wait until ``condition()`` is true, asking every ``period`` [s]; its value.

        Raises:
            ProgramError: the program ended, or ``timeout`` [s] went by; then it says
                ``complaint``, a text or a function that gives one.
        """
        deadline = time.monotonic() + timeout
        while True:
            check_interruption()
            value = condition()
            if value:
                return value
            self.check()
            if time.monotonic() > deadline:
                text = complaint() if callable(complaint) else complaint
                raise self.error(f"after {timeout:g} s {text}")
            time.sleep(period)

    def stop(self):
        """End the program, by force if it does not heed the request."""
        for number, patience in ((signal.SIGTERM, _PATIENCE), (signal.SIGKILL, None)):
            if self._process.poll() is not None:
                return
            os.killpg(self._process.pid, number)
            try:
                self._process.wait(patience)
            except subprocess.TimeoutExpired:
                continue

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.stop()
