"""What the rostests have in common: the scenario, and nodes' messages kept to look at."""

import threading
import time

import numpy as np
import rospy
import rostest
from rospy.numpy_msg import numpy_msg

from deformable_manipulation.msg import ControllerState, ObjectState
from deformable_manipulation.ros.conversions import agent_order, agent_positions
from deformable_manipulation.ros.node import BUFFER_SIZE
from deformable_manipulation.running.closed_loop import ClosedLoop
from deformable_manipulation.scenario import scenario_from_mapping

PACKAGE = "deformable_manipulation"
DEADLINE = 60.0  # s, of real time, for what takes a fraction of it
_POLLING_PERIOD = 0.01  # s, where nothing notifies


def run_tests(name):
    """Run the test cases of the program as a node of this name."""
    rospy.init_node(name)
    rostest.rosrun(PACKAGE, name, "__main__")


def read_scenario(parameter="scenario"):
    """The scenario that the run's nodes got."""
    return scenario_from_mapping(rospy.get_param(parameter), ".")


def poll(condition, what):
    """Wait until ``condition()`` is true; fails with ``what`` when it takes too long."""
    deadline = time.monotonic() + DEADLINE
    while not condition():
        if time.monotonic() > deadline:
            raise AssertionError("Waited {} s in vain for {}".format(DEADLINE, what))
        time.sleep(_POLLING_PERIOD)


def call(name, service_class, *arguments):
    """Call a service as soon as it is there."""
    rospy.wait_for_service(name, timeout=DEADLINE)
    return rospy.ServiceProxy(name, service_class)(*arguments)


class Messages(list):
    """Every message of a topic in the order of arrival, from when the publisher is connected.

    Args:
        topic, message_class: to subscribe to.
        answer: called with each message once it is kept.
    """

    def __init__(self, topic, message_class, answer=None):
        super().__init__()
        self._topic = topic
        self._answer = answer
        self._arrival = threading.Condition()
        self._subscriber = rospy.Subscriber(
            topic, message_class, self._keep, buff_size=BUFFER_SIZE, tcp_nodelay=True
        )
        poll(self._subscriber.get_num_connections, "a publisher of " + topic)

    def is_disconnected(self):
        """Whether all publishers have gone."""
        return self._subscriber.get_num_connections() == 0

    def _keep(self, message):
        with self._arrival:
            self.append(message)
            self._arrival.notify_all()
        if self._answer is not None:
            self._answer(message)

    def wait_for(self, condition, what, start=0):
        """The first message from number ``start`` on for which ``condition(message)`` holds."""
        deadline = time.monotonic() + DEADLINE
        position = start
        with self._arrival:
            while True:
                for message in self[position:]:
                    if condition(message):
                        return message
                position = max(start, len(self))
                if not self._arrival.wait(deadline - time.monotonic()):
                    raise AssertionError(
                        "Waited {} s in vain for {} on {}; the last of {} messages is\n{}".format(
                            DEADLINE, what, self._topic, len(self), self[-1] if self else None
                        )
                    )

    def wait_for_cycle(self, cycle, reset_count=0):
        """Wait until a cycle has come, and give all messages up to then."""
        self.wait_for(
            lambda message: message.cycle >= cycle and message.reset_count >= reset_count,
            "cycle {} after {} resets".format(cycle, reset_count),
        )
        return list(self)

    def wait_for_more(self, count):
        """Wait for so many new messages, and give them."""
        start = len(self)
        self.wait_for(lambda message: len(self) >= start + count, "more messages", start)
        return self[start : start + count]


def observe_controllers(scenario):
    """ControllerState messages of each assistant, by its name."""
    return {
        scenario.agents[index].name: Messages(
            scenario.agents[index].name + "/controller_state", ControllerState
        )
        for index in scenario.assistants
    }


def observe_states(answer=None, namespace=""):
    """State messages; a lock-step run starts with this."""
    return Messages(namespace + "state", numpy_msg(ObjectState), answer)


def velocities_of(state, scenario):
    """The agents' velocities (A, 3) [m/s] in the scenario's order."""
    return state.agent_velocities.reshape(-1, 3)[agent_order(state, scenario)]


def command_of(decision):
    """The velocity (3,) [m/s] in a ControllerState."""
    return np.array([decision.velocity_x, decision.velocity_y, decision.velocity_z])


def turning_of(decision):
    """The angular velocity (3,) [rad/s] in a ControllerState."""
    return np.array(
        [decision.angular_velocity_x, decision.angular_velocity_y, decision.angular_velocity_z]
    )


def object_points(state):
    """Geometry points (P, 3) [m] of the object itself."""
    return state.points[: 3 * state.point_count].reshape(-1, 3)


def records_without_ros(scenario, cycles):
    """The same run in one process."""
    loop = ClosedLoop(scenario)
    return [loop.step() for _ in range(cycles)]


def assert_same_positions(states, records, scenario, tolerance):
    """Agents and object are at the same places, cycle by cycle."""
    for state, record in zip(states, records):
        where = "cycle {}".format(record.cycle)
        np.testing.assert_allclose(
            agent_positions(state, scenario), record.positions, 0.0, tolerance, err_msg=where
        )
        np.testing.assert_allclose(
            object_points(state), record.points, 0.0, tolerance, err_msg=where
        )
