"""One assistant's controller under ROS."""

import threading

import rospy
from geometry_msgs.msg import TwistStamped
from std_msgs.msg import Header
from std_srvs.srv import SetBool, SetBoolResponse, Trigger, TriggerResponse

from deformable_manipulation.control.controller import AssistantController
from deformable_manipulation.control.status import Status
from deformable_manipulation.msg import ControllerState
from deformable_manipulation.ros import node
from deformable_manipulation.ros.conversions import fill_controller_state, to_twist
from deformable_manipulation.ros.health import DecisionMonitor
from deformable_manipulation.ros.live_parameters import LiveParameters
from deformable_manipulation.ros.marker_publisher import MarkerPublisher
from deformable_manipulation.ros.target_markers import target_markers

_NO_STATE = "Nothing changed: there is no state that can be used; see controller_state."


class Assistant:
    """Topics and services of an assistant's controller; which node it is in does not matter.

    Reads the node's parameters ``~enabled``, ``~safety`` and ``~lockstep``.

    Args:
        scenario: the checked scenario.
        agent: name of the assistant.
        counter: the node's :class:`~.cycle_counter.CycleCounter`, for ControllerState.

    Raises:
        ValueError: the scenario has no assistant of that name, or an unusable setting.
    """

    def __init__(self, scenario, agent, counter):
        self._scenario = scenario
        self._agent = agent
        self._counter = counter
        self._lock = threading.RLock()  # services and messages come in different threads
        self._controller = AssistantController(scenario, agent, rospy.get_param("~safety", True))
        self._controller.enabled = rospy.get_param("~enabled", True)
        self._warnings = node.Warnings()
        self._answered = None  # newest state answered
        self._observation = None  # of the newest state, while its inputs can be used
        self._stopped = False
        self._commands = rospy.Publisher(
            f"{agent}/cmd_vel",
            TwistStamped,
            queue_size=node.QUEUE_SIZE,
            tcp_nodelay=True,
            latch=rospy.get_param("~lockstep", False),
        )
        self._states = rospy.Publisher(
            f"{agent}/controller_state", ControllerState, queue_size=node.QUEUE_SIZE
        )
        self._markers = MarkerPublisher(self._draw)
        self._decisions = DecisionMonitor()
        self._live_parameters = LiveParameters(scenario, agent, self._change_parameters)
        rospy.Service(f"{agent}/enable", SetBool, self._enable)
        rospy.Service(f"{agent}/take_reference", Trigger, self._take_reference)
        node.await_subscribers(self._states)
        rospy.on_shutdown(self._stop)

    @property
    def reports(self):
        """For publish_diagnostics."""
        return {f"{self._agent} quadratic program": self._decisions.report}

    def decide(self, state, observation, fault=""):
        """The Decision that answers a state.

        Args:
            state: the ObjectState.
            observation: what the controller sees of it; None: it cannot be used.
            fault: a clause that says why not.
        """
        with self._lock:
            if self._answered is not None and state.reset_count != self._answered.reset_count:
                self._controller.reset()
            self._answered = state
            self._observation = observation
            if observation is None:
                return self._controller.wait(fault)
            return self._controller.update(observation)

    def send(self, state, decision):
        """Command what was decided on a state."""
        with self._lock:
            if not self._stopped:
                self._commands.publish(self._command(state, decision.command))

    def report(self, state, observation, decision):
        """Tell everybody else, who is in no hurry."""
        self._decisions.decided(decision)
        if decision.status == Status.WAITING:
            self._warnings.warn(f"{self._agent}: {decision.text}")
        if self._states.get_num_connections():
            message = fill_controller_state(ControllerState(), state, self._agent, decision)
            message.overruns = self._counter.overruns
            message.skipped_states = self._counter.skipped
            self._states.publish(message)
        if observation is not None:
            self._markers.show(state.header, observation.positions, decision)

    def _command(self, state, velocity):
        command = to_twist(TwistStamped(), state, velocity)
        # Not the frame of a state that is refused for it: a stop has to be accepted.
        command.header = Header(stamp=state.header.stamp, frame_id=self._scenario.frame)
        return command

    def _draw(self, header, positions, decision):
        leader = positions[self._scenario.leader_index]
        return target_markers(header, self._agent, leader, decision)

    def _enable(self, request):
        with self._lock:
            if request.data and self._observation is None:
                return SetBoolResponse(False, _NO_STATE)
            self._controller.enabled = request.data
        return SetBoolResponse(True, "Follows the leader." if request.data else "Stands still.")

    def _change_parameters(self, scenario):
        with self._lock:
            self._controller.set_parameters(scenario)

    def _take_reference(self, _request):
        with self._lock:
            if self._observation is None:
                return TriggerResponse(False, _NO_STATE)
            try:
                self._controller.take_reference(self._observation)
            except ValueError as error:
                return TriggerResponse(False, f"Nothing changed: {error}.")
        return TriggerResponse(True, "Follows the leader at the present relative position.")

    def _stop(self):
        """The last command is to stand still."""
        with self._lock:
            self._stopped = True
            if self._answered is not None:
                stop = self._command(self._answered, (0.0, 0.0, 0.0))
                node.publish_last(self._commands, stop)
