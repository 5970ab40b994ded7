#!/usr/bin/env python3
"""Which commands move an agent of the simulator in real time, and which do not."""

import unittest

import numpy as np
import rospy
from geometry_msgs.msg import TwistStamped
from observed_run import call, observe_states, poll, read_scenario, run_tests, velocities_of
from std_srvs.srv import Trigger

from deformable_manipulation.ros.conversions import agent_positions

AGENT = "assistant_1"
GOOD = (0.0, 0.01, 0.02)  # m/s
BAD = (0.0, -0.1, 0.1)  # m/s
REST = (0.0, 0.0, 0.0)
FURTHER = 10  # cycles


class Commander:
    """Answers each state of a simulator with the commands that a test wants.

    Attributes:
        answer: function of a state, gives a list of TwistStamped.
        sent: all commands.
    """

    def __init__(self, namespace):
        self.scenario = read_scenario(namespace + "scenario")
        self.row = next(i for i, each in enumerate(self.scenario.agents) if each.name == AGENT)
        self.sent = []
        self.answer = silence
        self._namespace = namespace
        self._publisher = rospy.Publisher(
            namespace + AGENT + "/cmd_vel", TwistStamped, queue_size=100, tcp_nodelay=True
        )
        poll(self._publisher.get_num_connections, "the simulator's subscription")
        self.states = observe_states(self._publish, namespace)

    def _publish(self, state):
        for command in self.answer(state):
            self.sent.append(command)
            self._publisher.publish(command)

    def velocity(self, state):
        return tuple(velocities_of(state, self.scenario)[self.row])

    def position(self, state):
        return agent_positions(state, self.scenario)[self.row]

    def reset(self):
        """Back to the start, at rest and with no command known; returns that state."""
        self.answer = silence
        resets = self.states[-1].reset_count if self.states else 0
        call(self._namespace + "reset", Trigger)
        return self.states.wait_for(lambda state: state.reset_count > resets, "a reset state")

    def wait_for_velocity(self, velocity, start=0):
        return self.states.wait_for(
            lambda state: np.allclose(self.velocity(state), velocity, 0.0, 1e-12),
            "velocity {}".format(velocity),
            start,
        )

    def velocities_with(self, answer):
        """All velocities while states get these answers, until and after GOOD acts."""
        start = len(self.states)
        self.answer = answer
        self.wait_for_velocity(GOOD, start)
        self.states.wait_for_more(FURTHER)
        return {self.velocity(state) for state in self.states[start:]}


def silence(_state):
    return []


def command(state, velocity, after=0.0):
    """A command that answers a state, or another one so much later [s]."""
    message = TwistStamped()
    message.header.frame_id = state.header.frame_id
    message.header.stamp = state.header.stamp + rospy.Duration(after)
    linear = message.twist.linear
    linear.x, linear.y, linear.z = velocity
    return message


class CommandsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.commander = Commander(rospy.get_namespace())

    def setUp(self):
        self.commander.reset()

    def assert_never_moves(self, make):
        """``make(state)`` never moves the agent; the good command sent after it does."""
        seen = self.commander.velocities_with(lambda state: [make(state), command(state, GOOD)])
        self.assertEqual(seen, {REST, GOOD})

    def test_an_answer_to_the_newest_state_moves_the_agent(self):
        commander = self.commander
        start = commander.position(commander.states[-1])
        self.assertEqual(commander.velocities_with(lambda s: [command(s, GOOD)]), {REST, GOOD})
        travelled = commander.position(commander.states[-1]) - start
        self.assertGreater(travelled[2], 0.9 * FURTHER * commander.scenario.cycle_time * GOOD[2])
        np.testing.assert_allclose(np.cross(travelled, GOOD), 0.0, atol=1e-12)

    def test_a_command_that_is_not_finite_is_dropped(self):
        for bad in (float("nan"), float("inf")):
            with self.subTest(value=bad):
                self.commander.reset()
                self.assert_never_moves(lambda state, bad=bad: command(state, (bad, *BAD[1:])))

    def test_a_command_that_no_agent_can_follow_is_dropped(self):
        for bad in (11.0, 1e300):
            with self.subTest(value=bad):
                self.commander.reset()
                self.assert_never_moves(lambda state, bad=bad: command(state, (bad, *BAD[1:])))

    def test_an_angular_velocity_that_is_not_finite_or_too_high_is_dropped(self):
        for bad in (float("nan"), 61.0):

            def make(state, bad=bad):
                message = command(state, BAD)
                message.twist.angular.y = bad
                return message

            with self.subTest(value=bad):
                self.commander.reset()
                self.assert_never_moves(make)

    def test_a_command_in_another_frame_is_dropped(self):
        def make(state):
            message = command(state, BAD)
            message.header.frame_id = "tool0"
            return message

        self.assert_never_moves(make)

    def test_a_command_from_the_future_is_dropped(self):
        self.assert_never_moves(lambda state: command(state, BAD, after=10.0))

    def test_a_command_that_is_older_than_the_timeout_does_not_move(self):
        self.assert_never_moves(lambda state: command(state, BAD, after=-10.0))

    def test_a_command_out_of_order_is_dropped(self):
        earlier = -self.commander.scenario.cycle_time
        seen = self.commander.velocities_with(
            lambda state: [command(state, GOOD), command(state, BAD, after=earlier)]
        )
        self.assertEqual(seen, {REST, GOOD})

    def test_a_second_answer_to_the_same_state_is_dropped(self):
        seen = self.commander.velocities_with(
            lambda state: [command(state, GOOD), command(state, BAD)]
        )
        self.assertEqual(seen, {REST, GOOD})

    def test_an_agent_stands_when_commands_stop(self):
        commander = self.commander
        commander.velocities_with(lambda state: [command(state, GOOD)])
        commander.answer = silence
        commander.wait_for_velocity(REST, len(commander.states))
        last = commander.sent[-1].header.stamp
        states = list(commander.states)
        timeout = rospy.Duration(commander.scenario.controller.timeout)
        too_old = [state.header.stamp - last > timeout for state in states]
        # What is decided after a state has come acts from the next one on: two states later.
        moving = [commander.velocity(state) != REST for state in states]
        self.assertTrue(any(too_old))
        self.assertFalse(any(old and moves for old, moves in zip(too_old, moving[2:])))


class PatientSimulatorTest(unittest.TestCase):
    def test_a_stop_may_answer_the_same_state_again(self):
        commander = Commander("/patient/")
        commander.velocities_with(lambda state: [command(state, GOOD)])
        commander.answer = silence
        commander.states.wait_for_more(FURTHER)
        start = len(commander.states)
        commander.answer = lambda state: [command(commander.sent[-1], REST)]
        commander.wait_for_velocity(REST, start)


if __name__ == "__main__":
    run_tests("commands")
