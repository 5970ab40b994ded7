"""How every command ends when it is interrupted or its output cannot be written: in one line."""

import importlib
import os
import signal
import sys
from typing import Sequence

from deformable_manipulation.commands.failure import fail
from deformable_manipulation.system.interruption import (
    check_interruption,
    exit_status,
    interruptible,
)

CLOSED = 128 + signal.SIGPIPE  # exit status when the reader of a pipe has gone, as of other tools


def run_command(name: str, arguments: Sequence[str]) -> int:
    """Import and run ``commands.<name>.main(arguments)``; returns its exit status.

    The import is guarded, too: it is most of what a short command does.
    """
    with interruptible():
        try:
            status = _run(name, arguments)
            sys.stdout.flush()  # what fails at exit could only be told by a traceback
            return status
        except KeyboardInterrupt as interrupt:
            return exit_status(interrupt)
        except BrokenPipeError:
            _discard_output()
            return CLOSED
        except ModuleNotFoundError as error:
            if (error.name or "deformable_manipulation").startswith("deformable_manipulation"):
                raise  # a bug
            return fail(name, f"the Python module '{error.name}' is needed but not installed")
        except OSError as error:
            _discard_output()
            if error.filename is not None:  # a file of the package, or a bug
                return fail(name, f"{error.filename}: {error.strerror or error}")
            return fail(name, f"cannot write the output: {error.strerror or error}")


def _run(name: str, arguments: Sequence[str]) -> int:
    try:
        command = importlib.import_module(f"deformable_manipulation.commands.{name}")
        check_interruption()
        return command.main(arguments)
    except SystemExit as stop:  # of argparse, with something printed
        return int(stop.code or 0)
    except Exception:
        check_interruption()  # libraries that are being loaded make other errors of it
        raise


def _discard_output() -> None:
    """What is still buffered would be written, and fail again, at exit."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, sys.stdout.fileno())
    os.close(nowhere)
