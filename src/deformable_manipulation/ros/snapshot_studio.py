"""A run and a virtual display, to take pictures of one on the other."""

import contextlib
import sys
from pathlib import Path

import rospy

from deformable_manipulation.ros.picture import PictureAtRest
from deformable_manipulation.ros.private_master import private_master
from deformable_manipulation.ros.program import ProgramCrashed
from deformable_manipulation.ros.rviz_view import rviz_view
from deformable_manipulation.ros.stepped_run import MarkerWatch, stepped_run
from deformable_manipulation.ros.virtual_display import virtual_display

_CRASHES = 2  # RViz corrupts its memory now and then while it starts


@contextlib.contextmanager
def snapshot_studio(scenario, configuration, size, directory):
    """Everything for pictures of a scenario's run, for the time of a with statement.

    Args:
        scenario: the checked scenario.
        configuration: text of an RViz configuration for a bare view.
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
            with stepped_run(scenario, directory) as run:
                yield SnapshotStudio(run, configuration, display, directory)
        finally:
            rospy.signal_shutdown("done")


class SnapshotStudio:
    """Takes pictures of a run at given times."""

    def __init__(self, run, configuration, display, directory):
        self._run = run
        self._configuration = configuration
        self._display = display
        self._directory = Path(directory)

    def go_to(self, time, progress=None):
        """Advance the run to a time [s]; see SteppedRun."""
        self._run.go_to(time, progress)

    def take(self, timeout):
        """The picture (height, width, 3) of the present state.

        Each picture has an RViz of its own, which has never seen another state, and which costs
        nothing while the run goes on.

        Raises:
            ProgramError: RViz ended, or the scene was not shown within ``timeout`` [s].
        """
        for _ in range(_CRASHES):
            try:
                return self._take(timeout)
            except ProgramCrashed as crash:
                print(f"{crash}\nTrying once more.", file=sys.stderr)
        return self._take(timeout)

    def _take(self, timeout):
        with rviz_view(self._configuration, self._display, self._directory) as view:
            topic = MarkerWatch.topic
            publishers = view.program.wait_until(
                lambda: view.publishers(topic),
                timeout,
                f"nothing was rendered: RViz did not receive {topic}",
            )
            self._await_markers(view.program, publishers, timeout)
            look = PictureAtRest(self._display.pixels)
            view.program.wait_until(look.again, timeout, look.complaint)
            return look.picture

    def _await_markers(self, rviz, publishers, timeout):
        with contextlib.closing(self._run.watch_markers()) as watch:

            def are_drawn():
                rviz.check()
                return not watch.missing(publishers)

            self._run.wait_until(
                are_drawn,
                timeout,
                lambda: f"nothing was rendered: {watch.describe(watch.missing(publishers))}",
            )
