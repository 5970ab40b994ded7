"""A run that goes on to given times and stands still there."""

import contextlib
from pathlib import Path

import rospy
from rospy.numpy_msg import numpy_msg
from std_srvs.srv import SetBool

from deformable_manipulation.msg import ObjectState
from deformable_manipulation.ros.launched_run import launch_command
from deformable_manipulation.ros.node import BUFFER_SIZE
from deformable_manipulation.srv import Step
from deformable_manipulation.system.program import Program, ProgramError

_TIMEOUT = 60.0  # s of real time, for the nodes to start and for a cycle


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
    command = launch_command(scenario, directory, lockstep="true", observers=1, one_process="false")
    with Program("the run", command, Path(directory) / "run.log") as program:
        yield SteppedRun(scenario, program)


class SteppedRun:
    """Advances a run to given times; this process must be a ROS node.

    Attributes:
        state: the newest ObjectState.
    """

    def __init__(self, scenario, program):
        self._scenario = scenario
        self._program = program
        self.state = None
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
            raise ProgramError(f"The run does not continue: {answer.message}")
        for cycle in range(start + 1, start + cycles + 1):
            self._await_cycle(cycle)
            if progress is not None:
                progress((cycle - start) / cycles)

    def wait_until(self, condition, timeout, complaint, **options):
        """Wait for something that the run does; see Program.wait_until."""
        return self._program.wait_until(condition, timeout, complaint, **options)

    def markers(self):
        """Markers that no node draws: none."""
        return []

    def _pause(self):
        try:
            return rospy.ServiceProxy("pause", SetBool)(True).success
        except (rospy.ServiceException, OSError):
            return False  # not there yet

    @property
    def _cycle(self):
        return -1 if self.state is None else self.state.cycle

    def _on_state(self, state):
        self.state = state

    def _await_cycle(self, cycle):
        self._program.wait_until(
            lambda: self._cycle >= cycle,
            _TIMEOUT,
            "the run did not continue from "
            f"{max(self._cycle, 0) * self._scenario.cycle_time:.2f} s",
        )
