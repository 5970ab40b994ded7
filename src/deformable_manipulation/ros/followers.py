"""Which assistants follow the leader."""

import rospy
from std_msgs.msg import Bool


class Followers:
    """The assistants that a leader waits for, as they tell on ``<assistant>/following``.

    Args:
        names: of the assistants; none: nobody is waited for.
    """

    def __init__(self, names):
        self._follows = dict.fromkeys(names, False)
        self._subscribers = {
            name: rospy.Subscriber(f"{name}/following", Bool, self._keep, callback_args=name)
            for name in names
        }

    def _keep(self, message, name):
        self._follows[name] = message.data

    def missing(self):
        """Names of those that do not follow, or whose node is gone."""
        return [
            name
            for name, follows in self._follows.items()
            if not (follows and self._subscribers[name].get_num_connections())
        ]

    def wait_text(self):
        """A sentence that says whom the leader waits for."""
        names = " and ".join(self.missing()) or "a state"
        return f"The leader's path starts when all assistants follow. Waiting for {names}."
