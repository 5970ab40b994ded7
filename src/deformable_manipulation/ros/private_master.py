"""A ROS master of one's own beside whatever runs on the machine."""

import contextlib
import os
import socket
from pathlib import Path

import rosgraph

from deformable_manipulation.ros.program import Program, ProgramError

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
                program.wait_until(_is_ready, _TIMEOUT, "the ROS master did not answer yet")
                break
            except ProgramError:
                if attempt == _ATTEMPTS - 1:
                    raise
        yield program


def _is_ready():
    """Whether the master answers, and roscore has done with it."""
    try:
        return rosgraph.Master("/probe").lookupNode("/rosout")
    except (rosgraph.MasterException, OSError):
        return False


def _free_port():
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        return probe.getsockname()[1]
