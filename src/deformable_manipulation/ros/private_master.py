"""A ROS master of one's own beside whatever runs on the machine."""

import contextlib
import functools
import http.client
import os
import socket
import xmlrpc.client
from pathlib import Path

import rosgraph

from deformable_manipulation.system.program import Program, ProgramError

_TIMEOUT = 60.0  # s, for the master to answer
_ATTEMPTS = 3


@contextlib.contextmanager
def private_master(directory):
    """A master on a free port, which this process and its programs use; for a with statement.

    Changes this process's environment, which rospy reads: to be entered before a node is
    initialized.

    Args:
        directory: existing folder for logs.

    Yields:
        Program: the master.

    Raises:
        ProgramError: it does not start.
    """
    os.environ["ROS_LOG_DIR"] = str(directory)
    os.environ["ROS_HOSTNAME"] = "localhost"
    os.environ.pop("ROS_IP", None)
    os.environ.pop("ROS_NAMESPACE", None)
    with contextlib.ExitStack() as stack:
        for attempt in range(_ATTEMPTS):
            port = _free_port()
            os.environ["ROS_MASTER_URI"] = f"http://localhost:{port}"
            # It refuses to start where another process was faster in taking the port.
            command = ["roscore", "-p", str(port)]
            program = Program("roscore", command, Path(directory) / "roscore.log")
            stack.enter_context(program)
            try:
                program.wait_until(
                    functools.partial(_is_ready, program),
                    _TIMEOUT,
                    "the ROS master did not answer yet",
                )
                break
            except ProgramError:
                if attempt == _ATTEMPTS - 1:
                    raise
        yield program


def _is_ready(roscore):
    """Whether the master of this roscore answers, and roscore has done with it.

    A process that was faster in taking the port may be a node, or even the master of another run.
    """
    master = rosgraph.Master("/probe")
    try:
        return _parent(master.getPid()) == roscore.pid and master.lookupNode("/rosout")
    except (rosgraph.MasterException, OSError, http.client.HTTPException, xmlrpc.client.Error):
        return False


def _parent(pid):
    """The parent of a process."""
    status = Path(f"/proc/{pid}/status").read_text()
    return int(status.partition("PPid:")[2].split()[0])


def _free_port():
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        return probe.getsockname()[1]
