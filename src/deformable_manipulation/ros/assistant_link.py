"""Topics and services of one assistant, at the node of its controller."""

import rospy
from geometry_msgs.msg import TwistStamped
from std_msgs.msg import Bool, Header
from std_srvs.srv import SetBool, Trigger

from deformable_manipulation.msg import ControllerState
from deformable_manipulation.ros import node
from deformable_manipulation.ros.conversions import fill_controller_state, to_twist
from deformable_manipulation.ros.direct_publisher import DirectPublisher


class AssistantLink:
    """Sends an assistant's commands and controller states.

    Reads the node's parameter ``~lockstep``: then the last command is kept for an agent that comes
    late.

    Args:
        name: of the assistant.
        frame: the scenario's fixed frame.
        counter: the node's :class:`~.cycle_counter.CycleCounter`, for ControllerState.
    """

    def __init__(self, name, frame, counter):
        self.name = name
        self._frame = frame
        self._counter = counter
        self._commands = DirectPublisher(
            f"{name}/cmd_vel", TwistStamped, latch=rospy.get_param("~lockstep", False)
        )
        self._states = DirectPublisher(f"{name}/controller_state", ControllerState)
        self._following = DirectPublisher(f"{name}/following", Bool, latch=True)
        self._follows = None  # as published last

    def serve(self, enable, take_reference):
        """Offer the services; the callbacks get the assistant's name and the request."""
        rospy.Service(f"{self.name}/enable", SetBool, lambda call: enable(self.name, call))
        rospy.Service(
            f"{self.name}/take_reference", Trigger, lambda call: take_reference(self.name, call)
        )

    def await_subscribers(self):
        """See :func:`.node.await_subscribers`."""
        node.await_subscribers(self._states)

    def command(self, state, velocity, angular=(0.0, 0.0, 0.0)):
        """Send the velocity [m/s] that answers a state."""
        command = to_twist(TwistStamped(), state, velocity, angular)
        # Not the frame of a state that is refused for it: a stop has to be accepted.
        command.header = Header(stamp=state.header.stamp, frame_id=self._frame)
        self._commands.publish(command)

    def report(self, state, decision):
        """Send what was decided on a state, and why, if anybody listens."""
        if decision.status.follows != self._follows:
            self._follows = decision.status.follows
            self._following.publish(Bool(self._follows))
        if not self._states.get_num_connections():
            return
        message = fill_controller_state(ControllerState(), state, self.name, decision)
        message.overruns = self._counter.overruns
        message.skipped_states = self._counter.skipped
        self._states.publish(message)
