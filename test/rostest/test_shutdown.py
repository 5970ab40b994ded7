#!/usr/bin/env python3
"""The last command of a controller that is stopped is zero, however it is stopped."""

import os
import signal
import unittest
from xmlrpc.client import ServerProxy

import rosgraph
import rosnode
import rospy
from geometry_msgs.msg import TwistStamped
from observed_run import Messages, observe_states, poll, run_tests


def speed(command):
    linear = command.twist.linear
    return max(abs(linear.x), abs(linear.y), abs(linear.z))


def interrupt(name):
    """As roslaunch ends a node."""
    uri = rosgraph.Master(rospy.get_name()).lookupNode(name)
    _, _, process = ServerProxy(uri).getPid(rospy.get_name())
    os.kill(process, signal.SIGINT)


def kill(name):
    """As rosnode kill ends a node."""
    rosnode.kill_nodes([name])


class ShutdownTest(unittest.TestCase):
    def test_the_last_command_is_zero(self):
        agents = ("middle_assistant", "end_assistant")
        commands = {agent: Messages(agent + "/cmd_vel", TwistStamped) for agent in agents}
        states = observe_states()
        states.wait_for_cycle(20)
        for messages in commands.values():
            messages.wait_for(speed, "a command to move")
        if rospy.get_param("~one_process", False):
            interrupt("/assistants")
        else:
            interrupt("/middle_assistant_controller")
            kill("/end_assistant_controller")
        for agent, messages in commands.items():
            poll(messages.is_disconnected, "the end of {}'s controller".format(agent))
            last = [speed(message) for message in messages[-30:]]
            with self.subTest(agent=agent, last=last):
                self.assertEqual(last[-1], 0.0)
                self.assertTrue(any(last))  # it moved until then


if __name__ == "__main__":
    run_tests("shutdown")
