"""Topics and services of one assistant, at the node of its controller."""

import rospy
from geometry_msgs.msg import TwistStamped
from std_msgs.msg import Header
from std_srvs.srv import SetBool, Trigger

from deformable_manipulation.msg import ControllerState
from deformable_manipulation.ros import node
from deformable_manipulation.ros.conversions import fill_controller_state, to_twist


class AssistantLink:
    """Sends an assistant's commands and controller states.

    Args:
        name: of the assistant.
        frame: the scenario's fixed frame.
        latch: keep the last command for an agent that comes late.
    """

    def __init__(self, name, frame, latch):
        self.name = name
        self._frame = frame
        self._commands = rospy.Publisher(
            f"{name}/cmd_vel",
            TwistStamped,
            queue_size=node.QUEUE_SIZE,
            tcp_nodelay=True,
            latch=latch,
        )
        self._states = rospy.Publisher(
            f"{name}/controller_state", ControllerState, queue_size=node.QUEUE_SIZE
        )

    def serve(self, enable, take_reference):
        """Offer the services; the callbacks get the assistant's name and the request."""
        rospy.Service(f"{self.name}/enable", SetBool, lambda call: enable(self.name, call))
        rospy.Service(
            f"{self.name}/take_reference", Trigger, lambda call: take_reference(self.name, call)
        )

    def await_subscribers(self):
        """See :func:`.node.await_subscribers`."""
        node.await_subscribers(self._states)

    def send(self, state, decision):
        """The answer to a state."""
        self._commands.publish(self._command(state, decision.command))
        self._states.publish(fill_controller_state(ControllerState(), state, self.name, decision))

    def stop(self, state):
        """A command to stand still; no controller state."""
        self._commands.publish(self._command(state, (0.0, 0.0, 0.0)))

    def _command(self, state, velocity):
        command = to_twist(TwistStamped(), state, velocity)
        # Not the frame of a state that is refused for it: a stop has to be accepted.
        command.header = Header(stamp=state.header.stamp, frame_id=self._frame)
        return command
