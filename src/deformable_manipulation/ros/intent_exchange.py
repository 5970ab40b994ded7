"""What coordinated assistants of different processes tell one another."""

import rospy

from deformable_manipulation.msg import AssistantIntent
from deformable_manipulation.ros import node
from deformable_manipulation.ros.conversions import (
    MessageError,
    fill_intent,
    require_frame,
    to_intent,
)
from deformable_manipulation.ros.direct_publisher import DirectPublisher


class IntentExchange:
    """Publishes the intents of a controller's assistants, and hears those of the others.

    Does nothing if the controller plans for nobody else.

    Args:
        scenario: the checked scenario.
        controller: :class:`~deformable_manipulation.control.team.TeamController`.
        lock: to hold while the controller is used.
    """

    def __init__(self, scenario, controller, lock):
        self._scenario = scenario
        self._controller = controller
        self._lock = lock
        self._reset_count = None  # of the newest state answered
        self._warnings = node.Warnings()
        others = controller.others
        self._publishers = {
            name: DirectPublisher(f"{name}/intent", AssistantIntent)
            for name in (controller.names if others else ())
        }
        self._subscribers = [
            rospy.Subscriber(f"{name}/intent", AssistantIntent, self._hear, name, tcp_nodelay=True)
            for name in others
        ]

    def answers(self, state):
        """Note that a state is being answered: intents from before its reset do not count."""
        self._reset_count = state.reset_count

    def tell(self, state):
        """Publish how the own assistants go on from a state that has been answered."""
        for name, publisher in self._publishers.items():
            if publisher.get_num_connections():
                with self._lock:
                    intent = self._controller.intent(name)
                publisher.publish(fill_intent(AssistantIntent(), state, name, intent))

    def _hear(self, message, name):
        try:
            require_frame(f"{name}/intent", message, self._scenario)
            intent = to_intent(message, self._scenario)
        except MessageError as error:
            self._warnings.warn(f"An intent of {name} is ignored: {error}.")
            return
        with self._lock:
            if message.reset_count == self._reset_count:
                self._controller.hear(name, intent)
