"""Says when a node does not keep up with the states."""

import rospy

from deformable_manipulation.cycles.cycle_counter import CycleCounter
from deformable_manipulation.ros import node

_WARNING_PERIOD = 60.0  # s
_REMEDY = (
    "If there are many, this machine is too slow for the run: lower controller.rate, or use "
    "lockstep:=true."
)


def age_of(state):
    """Age [s] of a state by its stamp."""
    return (rospy.Time.now() - state.header.stamp).to_sec()


class OverrunReport:
    """Counts answers and overruns of a node: warns, and sums up when the node leaves.

    Args:
        period: cycle time [s].
    """

    def __init__(self, period):
        self.counter = CycleCounter(period)
        self._warnings = node.Warnings(_WARNING_PERIOD)
        rospy.on_shutdown(lambda: rospy.loginfo(self.counter.summary))

    def answered(self, state):
        """A state has just been answered."""
        if self.counter.count(state, age_of(state)):
            name = rospy.get_name()
            self._warnings.warn(f"{name}: {self.counter.summary} {_REMEDY}")
