"""A run that goes on to given times and stands still there."""

import contextlib
import threading
from pathlib import Path

import rospy
from rospy.numpy_msg import numpy_msg
from std_srvs.srv import SetBool
from visualization_msgs.msg import MarkerArray

from deformable_manipulation.msg import ObjectState
from deformable_manipulation.ros.launched_run import launch_command
from deformable_manipulation.ros.node import BUFFER_SIZE
from deformable_manipulation.ros.program import Program, ProgramError
from deformable_manipulation.srv import Step

_TIMEOUT = 60.0  # s of real time, for the nodes to start and for a cycle
_REDRAWS = 2  # of each node, so that what is drawn now and then is there, too


@contextlib.contextmanager
def stepped_run(scenario, directory):
    """A lock-step run of a scenario on this process's master, paused at time 0.

    Args:
        scenario: the checked scenario.
        directory: existing folder for its files.

    Yields:
        SteppedRun

    Raises:
        ProgramError: it does not start.
    """
    # One observer, this process, so that the run does not start before it is paused. A process for
    # each thing that is drawn, for MarkerWatch knows only who draws.
    command = launch_command(
        scenario, directory, lockstep="true", observers=1, one_process="false"
    )
    with Program("the run", command, Path(directory) / "run.log") as program:
        yield SteppedRun(scenario, program)


class SteppedRun:
    """Advances a run to given times; this process must be a ROS node."""

    def __init__(self, scenario, program):
        self._scenario = scenario
        self._program = program
        self._cycle = -1
        self._stamp = None
        program.wait_until(self._pause, _TIMEOUT, "the run's simulator did not answer yet")
        self._subscriber = rospy.Subscriber(
            "state",
            numpy_msg(ObjectState),
            self._on_state,
            queue_size=1,
            buff_size=BUFFER_SIZE,
            tcp_nodelay=True,
        )
        self._await_cycle(0)

    def go_to(self, time, progress=None):
        """Advance to a time [s] of the run, not before the present one, and stand still.

        Args:
            progress: called with the fraction done of the way from the present time.

        Raises:
            ProgramError: the run has ended or does not go on.
        """
        start = self._cycle
        cycles = round(time / self._scenario.cycle_time) - start
        if cycles <= 0:
            return
        answer = rospy.ServiceProxy("step", Step)(cycles)
        if not answer.success:
            raise ProgramError(f"The run does not go on: {answer.message}")
        for cycle in range(start + 1, start + cycles + 1):
            self._await_cycle(cycle)
            if progress is not None:
                progress((cycle - start) / cycles)

    def wait_until(self, condition, timeout, complaint):
        """Wait for something that the run does; see Program.wait_until."""
        return self._program.wait_until(condition, timeout, complaint)

    def watch_markers(self):
        """MarkerWatch for the present state."""
        return MarkerWatch(self._stamp)

    def _pause(self):
        try:
            return rospy.ServiceProxy("pause", SetBool)(True).success
        except (rospy.ServiceException, OSError):
            return False  # not there yet

    def _on_state(self, state):
        self._stamp = state.header.stamp
        self._cycle = state.cycle

    def _await_cycle(self, cycle):
        self._program.wait_until(
            lambda: self._cycle >= cycle,
            _TIMEOUT,
            f"the run did not go on from {max(self._cycle, 0) * self._scenario.cycle_time:.2f} s",
        )


class MarkerWatch:
    """Notices when every node has drawn a state since the watch began.

    Args:
        stamp: of the state.
    """

    topic = "/markers"

    def __init__(self, stamp):
        self._stamp = stamp
        self._redraws = {}
        self._drawn = {}  # stamp of the newest marker of each node
        self._lock = threading.Lock()
        self._subscriber = rospy.Subscriber(self.topic, MarkerArray, self._count, queue_size=100)

    def missing(self, publishers):
        """Those of these nodes that have not drawn the state yet, everything that they draw."""
        with self._lock:
            return [node for node in publishers if self._redraws.get(node, 0) < _REDRAWS]

    def describe(self, nodes):
        """What these nodes have drawn instead, for a message."""
        with self._lock:
            return ", ".join(
                f"{node} drew {self._state_text(self._drawn.get(node))}" for node in nodes
            )

    def _state_text(self, stamp):
        if stamp is None:
            return "nothing"
        if stamp == self._stamp:
            return "the state, but not again"
        return f"another state, {(stamp - self._stamp).to_sec():+.3f} s away"

    def close(self):
        """Stop watching."""
        self._subscriber.unregister()

    def _count(self, array):
        node = array._connection_header["callerid"]
        stamps = {marker.header.stamp for marker in array.markers}
        with self._lock:
            self._drawn[node] = max(stamps, default=None)
            if self._stamp in stamps:
                self._redraws[node] = self._redraws.get(node, 0) + 1
