"""A run and a virtual display, to take pictures of one on the other."""

import contextlib
import sys
import time
from pathlib import Path

import rospy
from visualization_msgs.msg import MarkerArray

from deformable_manipulation.pictures.picture import PictureAtRest, same_looks_after
from deformable_manipulation.ros.label_marker import label_markers
from deformable_manipulation.ros.marker_publisher import MarkerPublisher
from deformable_manipulation.ros.marker_watch import MarkerWatch
from deformable_manipulation.ros.private_master import private_master
from deformable_manipulation.ros.rviz_view import rviz_view, with_frame_rate
from deformable_manipulation.ros.virtual_display import virtual_display
from deformable_manipulation.system.program import ProgramCrashed

_CRASHES = 2  # RViz corrupts its memory now and then while it starts
_FILM_RATE = 30  # Hz, at which RViz draws while it is filmed
_FILM_PERIOD = 0.01  # s between questions whether a picture of a film is there


@contextlib.contextmanager
def snapshot_studio(open_run, leader, size, directory):
    """Everything for pictures of a run, for the time of a with statement.

    Args:
        open_run: makes the run's context manager, of a SteppedRun or PlayedRun.
        leader: the leader's name.
        size: width and height in pixels.
        directory: existing folder for temporary files.

    Yields:
        SnapshotStudio

    Raises:
        ProgramError: a program that is needed does not start.
    """
    with virtual_display(size, directory) as display, private_master(directory):
        # The command handles Ctrl-C itself.
        rospy.init_node("rviz_snapshot", anonymous=True, disable_signals=True)
        try:
            with open_run() as run:
                yield SnapshotStudio(run, leader, display, directory)
        finally:
            rospy.signal_shutdown("done")


def _anything(_):
    return True


class SnapshotStudio:
    """Takes pictures of a run.

    Configurations are RViz's, as of YAML, for a bare view.

    Attributes:
        run: the SteppedRun or PlayedRun, to be brought to the time of a picture.
        labels: texts in the scene, (place (3,) [m], text) of each.
        distance: the newest picture's distance to the obstacles and its limit, in words; empty:
            there is no obstacle.
    """

    def __init__(self, run, leader, display, directory):
        self.run = run
        self.labels = []
        self.distance = ""
        self._leader = leader
        self._display = display
        self._directory = Path(directory)
        self._markers = MarkerPublisher(self._draw)

    @property
    def leader(self):
        """Where the leader is (3,) [m]."""
        state = self.run.state
        return state.agent_positions.reshape(-1, 3)[list(state.agents).index(self._leader)].copy()

    def take(self, configuration, timeout, **looks):
        """The picture (height, width, 3) of the present state.

        Each picture has an RViz of its own, which has never seen another state, and which costs
        nothing while the run goes on.

        Args:
            timeout: s, for RViz to show the state.
            looks: options of PictureAtRest.

        Raises:
            ProgramError: RViz ended, or the scene was not shown in time.
        """
        with contextlib.ExitStack() as stack:
            return self._open(stack, configuration, timeout, looks)[1]

    def film(self, configuration, times, timeout):
        """Pictures (height, width, 3) of a PlayedRun at some times [s], one after the other.

        All are of one RViz; a picture may be of the time before where the machine is overloaded.

        Raises:
            ProgramError: RViz ended, or a state was not shown within ``timeout`` [s].
        """
        self.run.rewind()
        with contextlib.ExitStack() as stack:
            configuration = with_frame_rate(configuration, _FILM_RATE)
            view, _ = self._open(stack, configuration, timeout, {})
            publishers = view.publishers(MarkerWatch.topic)
            watch = MarkerWatch(self.run.state.header.stamp, times=1)
            stack.callback(watch.close)
            for time in times:
                watch.expect(self.run.stamp(time))
                self.run.show(time)
                self._markers.show(self.run.state)
                self._await_markers(view.program, watch, publishers, timeout)
                yield self._await_rest(
                    view.program, timeout, shows=_anything, period=1.0 / _FILM_RATE, same_looks=2
                )

    def _open(self, stack, configuration, timeout, looks):
        """A view that shows the present state, and its picture."""
        for attempt in range(_CRASHES + 1):
            with contextlib.ExitStack() as attempted:
                started = time.monotonic()
                try:
                    view = attempted.enter_context(
                        rviz_view(configuration, self._display, self._directory)
                    )
                    picture = self._first_picture(view, started, timeout, looks)
                except ProgramCrashed as crash:
                    if attempt == _CRASHES:
                        raise
                    print(f"{crash}\nTrying once more.", file=sys.stderr)
                    continue
                stack.push(attempted.pop_all())
                return view, picture

    def _first_picture(self, view, started, timeout, looks):
        self._markers.show(self.run.state)
        topic = MarkerWatch.topic
        publishers = view.program.wait_until(
            lambda: view.publishers(topic),
            timeout,
            f"nothing was rendered: RViz did not receive {topic}",
        )
        with contextlib.closing(MarkerWatch(self.run.state.header.stamp)) as watch:
            self._await_markers(view.program, watch, publishers, timeout)
        same_looks = same_looks_after(time.monotonic() - started)
        return self._await_rest(view.program, timeout, same_looks=same_looks, **looks)

    def _await_markers(self, rviz, watch, publishers, timeout):
        def are_drawn():
            rviz.check()
            return not watch.missing(publishers)

        self.run.wait_until(
            are_drawn,
            timeout,
            lambda: f"nothing was rendered: {watch.describe(watch.missing(publishers))}",
            period=_FILM_PERIOD,
        )
        self.distance = watch.distance

    def _await_rest(self, rviz, timeout, **options):
        look = PictureAtRest(self._display.pixels, **options)
        rviz.wait_until(look.again, timeout, look.complaint, period=_FILM_PERIOD)
        return look.picture

    def _draw(self, state):
        """What this process adds to the nodes' markers."""
        return MarkerArray([*self.run.markers(), *label_markers(state.header, self.labels)])
