"""Why there are no states."""

import rospy
from std_msgs.msg import String


class WaitingReason:
    """Says what keeps the simulator from publishing states, as it tells on ``waiting_for``."""

    def __init__(self):
        self._text = None  # what the simulator waits for; None: it has not said anything
        rospy.Subscriber("waiting_for", String, self._keep)

    def _keep(self, message):
        self._text = message.data

    def clause(self, had_state):
        """A clause that says why there is no state to act on.

        Args:
            had_state: whether there was one that could not be used.
        """
        if self._text:
            return f"the simulator waits for {self._text}"
        if had_state:
            return "there is no state that can be used; see controller_state"
        return "there is no state yet: the simulator is not running, or is still starting"
