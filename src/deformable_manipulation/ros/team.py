"""A controller under ROS, with the assistants that it commands."""

import threading

import rospy
from geometry_msgs.msg import WrenchStamped
from std_srvs.srv import SetBoolResponse, TriggerResponse
from visualization_msgs.msg import MarkerArray

from deformable_manipulation.control.status import Status
from deformable_manipulation.control.team import TeamController
from deformable_manipulation.cycles.health import DecisionMonitor
from deformable_manipulation.cycles.wrench_watch import WrenchWatch
from deformable_manipulation.ros import node
from deformable_manipulation.ros.assistant_link import AssistantLink
from deformable_manipulation.ros.conversions import to_measured_wrench
from deformable_manipulation.ros.intent_exchange import IntentExchange
from deformable_manipulation.ros.live_parameters import LiveParameters
from deformable_manipulation.ros.marker_publisher import MarkerPublisher
from deformable_manipulation.ros.target_markers import target_markers
from deformable_manipulation.ros.waiting_reason import WaitingReason


class Team:
    """Assistants whose velocities one controller decides; which node it is in does not matter.

    Reads the node's parameters ``~enabled``, ``~safety`` and ``~lockstep``.

    Args:
        scenario: the checked scenario.
        names: of the assistants.
        counter: the node's :class:`~.cycle_counter.CycleCounter`.

    Raises:
        ValueError: the scenario has no assistant of a name, or an unusable setting.
    """

    def __init__(self, scenario, names, counter):
        self._scenario = scenario
        self._lock = threading.RLock()  # services and messages come in different threads
        self._controller = TeamController(
            scenario,
            names,
            safety=rospy.get_param("~safety", True),
            trusting=rospy.get_param("~lockstep", False),
        )
        self._intents = IntentExchange(scenario, self._controller, self._lock)
        for name in names:
            self._controller.set_enabled(name, rospy.get_param("~enabled", True))
        self._warnings = node.Warnings()
        self._answered = None  # newest state answered
        self._observation = None  # of the newest state, while its inputs can be used
        self._stopped = False
        self._waiting = WaitingReason()
        self._links = [AssistantLink(name, scenario.frame, counter) for name in names]
        self._watch = self._watch_wrenches(names)
        self._markers = MarkerPublisher(self._draw)
        self._monitors = {name: DecisionMonitor() for name in names}
        # Of one assistant they go by its name, of several commanded together by `team`.
        self._live_parameters = LiveParameters(
            scenario, names[0] if len(names) == 1 else "team", self._change_parameters
        )
        for link in self._links:
            link.serve(self._enable, self._take_reference)
        for link in self._links:
            link.await_subscribers()
        rospy.on_shutdown(self._stop)

    @property
    def reports(self):
        """How the assistants fare, for publish_diagnostics."""
        return {
            f"{name} quadratic program": monitor.report for name, monitor in self._monitors.items()
        }

    def decide(self, state, observation, fault=""):
        """The Decisions that answer a state, by the assistants' names.

        Args:
            state: the ObjectState.
            observation: what the controller sees of it; None: it cannot be used.
            fault: a clause that says why not.
        """
        with self._lock:
            if self._answered is not None and state.reset_count != self._answered.reset_count:
                self._controller.reset()
                if self._watch is not None:
                    self._watch.reset()
            self._answered = state
            self._observation = observation
            self._intents.answers(state)
            if observation is None:
                return self._controller.wait(fault)
            fault = self._wrench_fault(state, observation)
            return self._controller.wait(fault) if fault else self._controller.update(observation)

    def send(self, state, decisions):
        """Command what was decided on a state."""
        with self._lock:
            if not self._stopped:
                for link in self._links:
                    decision = decisions[link.name]
                    link.command(state, decision.command, decision.angular_command)

    def report(self, state, observation, decisions):
        """Tell everybody else, who is in no hurry."""
        self._intents.tell(state)
        for link in self._links:
            decision = decisions[link.name]
            self._monitors[link.name].decided(decision)
            if decision.status == Status.WAITING:
                self._warnings.warn(f"{link.name}: {decision.text}")
            link.report(state, decision)
        if observation is not None:
            self._markers.show(state.header, observation.positions, decisions)

    def _watch_wrenches(self, names):
        """The WrenchWatch over the assistants' force sensors, or None."""
        settings = self._scenario.controller.wrench_watch
        if settings is None:
            return None
        for name in names:
            node.subscribe(
                f"{name}/measured_wrench",
                WrenchStamped,
                lambda message, name=name: self._take_wrench(name, message),
            )
        return WrenchWatch(settings, names, self._scenario.controller.timeout)

    def _take_wrench(self, name, message):
        with self._lock:
            if self._watch is not None:
                self._watch.measured(name, **to_measured_wrench(message, self._scenario))

    def _wrench_fault(self, state, observation):
        """A clause that says why force sensors stop the assistants; empty: they do not."""
        if self._watch is None:
            return ""
        time, faults = state.header.stamp.to_sec(), []
        for index in self._scenario.assistants:
            name = self._scenario.agents[index].name
            if name in self._controller.names and self._controller.is_enabled(name):
                faults.append(self._watch.check(name, time, observation.wrenches[0, index]))
        return "; ".join(filter(None, faults))

    def _draw(self, header, positions, decisions):
        leader = positions[self._scenario.leader_index]
        drawn = MarkerArray()
        for name, decision in decisions.items():
            drawn.markers += target_markers(header, name, leader, decision.target).markers
        return drawn

    def _enable(self, name, request):
        with self._lock:
            if request.data and self._observation is None:
                return SetBoolResponse(False, self._no_state())
            self._controller.set_enabled(name, request.data)
            if request.data and self._watch is not None:
                self._watch.rearm(name)
        return SetBoolResponse(True, "Follows the leader." if request.data else "Stands still.")

    def _no_state(self):
        return f"Nothing changed: {self._waiting.clause(self._answered is not None)}."

    def _change_parameters(self, scenario):
        with self._lock:
            self._controller.set_parameters(scenario)

    def _take_reference(self, name, _request):
        with self._lock:
            if self._observation is None:
                return TriggerResponse(False, self._no_state())
            try:
                self._controller.take_reference(name, self._observation)
            except ValueError as error:
                return TriggerResponse(False, f"Nothing changed: {error}.")
        return TriggerResponse(True, "Follows the leader at the present relative position.")

    def _stop(self):
        """The last command is to stand still."""
        with self._lock:
            self._stopped = True
            if self._answered is not None:
                for link in self._links:
                    link.command(self._answered, (0.0, 0.0, 0.0))
