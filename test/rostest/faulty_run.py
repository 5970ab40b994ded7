"""What the fault tests have in common: a run that moves, is disturbed, stops and goes on."""

import os
import signal
import subprocess
import unittest
from xmlrpc.client import ServerProxy

import rosgraph
import rospy
from observed_run import (
    PACKAGE,
    Messages,
    call,
    observe_states,
    poll,
    read_scenario,
    velocities_of,
)
from rosgraph_msgs.msg import Log
from roslib.packages import find_node
from std_srvs.srv import Trigger

from deformable_manipulation.control.status import Status
from deformable_manipulation.msg import ControllerState

AGENT = "assistant_1"
FOLLOWING = (Status.NOMINAL, Status.CONSTRAINED)
COMMON = {"simulator": "simulator_node", "leader": "leader_node"}
ONE_PROCESS = {"assistants": "assistants_node"}
PROCESSES = {"minimum_distance": "minimum_distance_node", "controller": "controller_node"}
_MOVING = 0.01  # m/s
_STANDING = 20  # cycles at rest in a row
_SCHEDULING = 0.5  # s, by which a busy machine may let a message wait


class FaultTest(unittest.TestCase):
    """A test that finds the assistant following, and no node gone at the end."""

    @classmethod
    def setUpClass(cls):
        cls.scenario = read_scenario()
        cls.row = [agent.name for agent in cls.scenario.agents].index(AGENT)
        cls.one_process = rospy.get_param("one_process")
        cls.executables = {**COMMON, **(ONE_PROCESS if cls.one_process else PROCESSES)}
        #: Name of the node with the controller.
        cls.controller = "assistants" if cls.one_process else "controller"
        poll(lambda: all(map(process_of, cls.executables)), "all nodes")
        cls.processes = {name: process_of(name) for name in cls.executables}
        cls.log = Messages("/rosout", Log)
        cls.decisions = Messages(AGENT + "/controller_state", ControllerState)
        cls.states = observe_states()

    def setUp(self):
        before = self.states.wait_for(lambda state: True, "a state", max(0, len(self.states) - 1))
        call("reset", Trigger)
        # States of the run before are still on their way.
        self.states.wait_for(
            lambda state: state.reset_count > before.reset_count, "a new run", len(self.states) - 1
        )
        self.assert_follows()
        self.log_start = len(self.log)
        self.addCleanup(self.assert_no_other_node_is_gone)

    def assert_no_other_node_is_gone(self):
        for name, process in self.processes.items():
            self.assertEqual(process_of(name), process, name)
            os.kill(process, 0)  # raises an error where there is no such process

    def velocity(self, state, row=None):
        """Velocity (3,) [m/s] of the assistant, or of another agent of the scenario."""
        return velocities_of(state, self.scenario)[self.row if row is None else row]

    def assert_follows(self):
        """From now on, sooner or later, the assistant follows and moves."""
        self.decisions.wait_for(
            lambda decision: decision.status in FOLLOWING, "following", len(self.decisions)
        )
        return self.states.wait_for(
            lambda state: abs(self.velocity(state)).max() > _MOVING,
            "a moving assistant",
            len(self.states),
        )

    def assert_goes_on(self, cycles=50):
        """From now on, sooner or later, the assistant follows for so many cycles on end.

        Returns:
            the decisions from the call to then.
        """
        start = len(self.decisions)
        self.decisions.wait_for(
            InARow(cycles, lambda decision: decision.status in FOLLOWING), "following", start
        )
        return self.decisions[start:]

    def assert_stops(self, since):
        """The assistant stands still within the timeout of a time, and goes on to do so.

        Returns:
            the state from which on it stands still.
        """
        start = next(
            (i for i, state in enumerate(self.states) if state.header.stamp > since),
            len(self.states),
        )
        standing = InARow(_STANDING, lambda state: not self.velocity(state).any())
        last = self.states.wait_for(standing, "an assistant at rest", start)
        index = next(i for i, state in enumerate(self.states) if state is last)
        first = self.states[index - _STANDING + 1]
        delay = (first.header.stamp - since).to_sec()
        rospy.loginfo("%s: at rest %.2f s after the fault", self.id(), delay)
        self.assertLess(delay, self.patience())
        return first

    def patience(self):
        """Time [s] from a fault to rest: what is lost is noticed, and the assistant slows down."""
        controller = self.scenario.controller
        braking = controller.max_velocity / controller.max_acceleration
        return 1.5 * controller.timeout + braking + _SCHEDULING

    def assert_says(self, *words):
        """The log has a line with all these words since the start of the test."""
        self.log.wait_for(
            lambda line: all(word in line.msg for word in words), str(words), self.log_start
        )

    def assert_waits(self, *words):
        """The controller waits at rest, sooner or later, and says why with these words."""
        self.decisions.wait_for(
            lambda decision: (
                decision.status == Status.WAITING
                and all(word in decision.status_text for word in words)
                and not any((decision.velocity_x, decision.velocity_y, decision.velocity_z))
            ),
            "waiting at rest: {}".format(words),
            len(self.decisions),
        )

    def kill(self, name):
        """End a node in a way that it cannot react to; the time of it."""
        now = rospy.Time.now()
        os.kill(self.processes.pop(name), signal.SIGKILL)
        return now

    def start(self, name, *arguments, executable=None):
        """Start a node, with the parameters it had if it ran before."""
        (path,) = find_node(PACKAGE, executable or self.executables[name])[:1]
        process = subprocess.Popen([path, "__name:=" + name, *arguments])
        self.addCleanup(process.wait)
        self.addCleanup(process.terminate)
        return process


class InARow:
    """True at the message that completes a row of so many for which a condition holds.

    A busy machine may interrupt a run for longer than the timeout, but not again and again.
    """

    def __init__(self, count, condition):
        self._wanted = count
        self._condition = condition
        self._count = 0

    def __call__(self, message):
        self._count = self._count + 1 if self._condition(message) else 0
        return self._count >= self._wanted


def process_of(name):
    """Number of a node's process; 0 if there is no such node that answers."""
    try:
        uri = rosgraph.Master(rospy.get_name()).lookupNode(rospy.resolve_name(name))
        return ServerProxy(uri).getPid(rospy.get_name())[2]
    except (rosgraph.MasterError, OSError):
        return 0
