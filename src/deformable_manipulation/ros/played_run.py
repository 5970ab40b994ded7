"""A recorded run, shown state by state with the markers of a live one."""

import contextlib
from pathlib import Path

import numpy as np
import rospy
from rospy.numpy_msg import numpy_msg

from deformable_manipulation.msg import ObjectState
from deformable_manipulation.ros.launched_run import playback_command
from deformable_manipulation.ros.target_markers import target_markers
from deformable_manipulation.system.program import Program

_TIMEOUT = 60.0  # s of real time, for the nodes to start
_START_OF_TIME = 1.0  # s, of stamps: zero means "not known yet"
_DRAWN_BY = 2  # nodes that subscribe to the state


@contextlib.contextmanager
def played_run(run, frames, directory):
    """What draws a recorded run, on this process's master, for the time of a with statement.

    Args:
        run: its recording.run_data.RunData.
        frames: its recording.frames.Frames.
        directory: existing folder for files.

    Yields:
        PlayedRun

    Raises:
        ProgramError: it does not start.
    """
    command = playback_command(frames.scenario, directory)
    with Program("the playback", command, Path(directory) / "playback.log") as program:
        yield PlayedRun(run, frames, program)


class PlayedRun:
    """Publishes the states of a recorded run; this process must be a ROS node.

    Attributes:
        state: the newest ObjectState.
    """

    def __init__(self, run, frames, program):
        self._run = run
        self._frames = frames
        self._program = program
        self._next = 0  # frame that no trail has yet
        self._reset_count = 0
        self.state = None
        self._publisher = rospy.Publisher("state", numpy_msg(ObjectState), queue_size=0)
        program.wait_until(
            lambda: self._publisher.get_num_connections() >= _DRAWN_BY,
            _TIMEOUT,
            "the nodes that draw the recorded states were not ready yet",
        )
        self.go_to(frames.times[0])

    def go_to(self, time, progress=None):
        """Show the state at a time [s], with all that the agents have moved along since the start.

        Args:
            progress: called with 1 at the end.
        """
        while self._next < len(self._frames.times) and self._frames.times[self._next] < time:
            self._publish(float(self._frames.times[self._next]))
            self._next += 1
        self.show(time)
        if progress is not None:
            progress(1.0)

    def rewind(self):
        """Back to the start, without trails."""
        self._next = 0
        self._reset_count += 1
        self.go_to(self._frames.times[0])

    def show(self, time):
        """Show the state at a time [s] alone."""
        self._publish(self._within(time))

    def stamp(self, time):
        """The stamp of the state that is shown for a time [s]."""
        return rospy.Time.from_sec(_START_OF_TIME + self._within(time))

    def markers(self):
        """The arrows from the leader to the assistants' targets, MarkerArray's markers."""
        scenario = self._frames.scenario
        leader = self.state.agent_positions.reshape(-1, 3)[scenario.leader_index]
        time = self.state.header.stamp.to_sec() - _START_OF_TIME
        arrows = []
        for series in self._run.assistants:
            row = min(np.searchsorted(series.time, time - 1e-6), len(series.time) - 1)
            array = target_markers(self.state.header, series.agent, leader, series.target[row])
            arrows += array.markers
        return arrows

    def wait_until(self, condition, timeout, complaint, **options):
        """Wait for something that the nodes do; see Program.wait_until."""
        return self._program.wait_until(condition, timeout, complaint, **options)

    def _within(self, time):
        """The time [s], or where there is no frame any more the nearest that has one."""
        return float(min(max(time, self._frames.times[0]), self._frames.times[-1]))

    def _publish(self, time):
        points, agents = self._frames.between(time)
        scenario = self._frames.scenario
        state = ObjectState()
        state.header.stamp = self.stamp(time)
        state.header.frame_id = scenario.frame
        state.cycle = round(time / scenario.cycle_time)
        state.reset_count = self._reset_count
        state.object_type = getattr(ObjectState, scenario.object.type.upper())
        state.point_count = len(points)
        state.points = points.ravel()
        state.agents = [agent.name for agent in scenario.agents]
        state.agent_particles = np.array([a.particle for a in scenario.agents], dtype=np.int32)
        further = [(k, i) for i, a in enumerate(scenario.agents) for k in a.further_particles]
        state.further_particles = np.array([particle for particle, _ in further], dtype=np.int32)
        state.further_agents = np.array([agent for _, agent in further], dtype=np.int32)
        state.agent_positions = agents.ravel()
        state.agent_orientations = np.tile([0.0, 0.0, 0.0, 1.0], len(agents))
        state.displaced_agents = np.array([-1], dtype=np.int32)
        state.displacements = np.zeros(3)
        state.copy_ready = bytes([1])
        self.state = state
        self._publisher.publish(state)
