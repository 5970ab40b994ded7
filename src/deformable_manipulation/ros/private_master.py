"""A ROS master of one's own beside whatever runs on the machine."""

import os
import socket
from pathlib import Path

import rosgraph

from deformable_manipulation.ros.program import Program, ProgramError

_TIMEOUT = 60.0  # s, for the master to answer
_ATTEMPTS = 3


def start_private_master(directory):
    """Start a master on a free port and make it this process's and its programs' master.

    Changes the environment, which rospy reads: to be called before a node is initialized.

    Args:
        directory: existing folder for logs.

    Returns:
        Program, for the caller to stop.

    Raises:
        ProgramError: it does not start.
    """
    os.environ["ROS_LOG_DIR"] = str(directory)
    os.environ["ROS_HOSTNAME"] = "localhost"
    os.environ.pop("ROS_IP", None)
    os.environ.pop("ROS_NAMESPACE", None)
    for attempt in range(_ATTEMPTS):
        port = _free_port()
        os.environ["ROS_MASTER_URI"] = f"http://localhost:{port}"
        # It refuses to start where another process was faster in taking the port.
        program = Program("roscore", ["roscore", "-p", str(port)], Path(directory) / "roscore.log")
        try:
            program.wait_until(_is_ready, _TIMEOUT, "The ROS master did not answer")
            return program
        except ProgramError:
            program.stop()
            if attempt == _ATTEMPTS - 1:
                raise
        except BaseException:
            program.stop()
            raise


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
