#!/usr/bin/env python3
"""Two nodes send commands to one agent."""

import signal

import rospy
from faulty_run import AGENT, FaultTest
from geometry_msgs.msg import TwistStamped
from observed_run import poll, run_tests

from deformable_manipulation.msg import ObjectState

SENTENCE = "nodes send commands on /assistant_1/cmd_vel"


class FaultPublishersTest(FaultTest):
    def assert_only_the_assistant_stands(self, since, sender):
        stopped = self.assert_stops(since)
        self.assert_says("assistant_1 stands still: 2", SENTENCE, "/" + self.controller, sender)
        self.assertTrue(self.velocity(stopped, self.scenario.leader_index).any())

    def test_a_second_controller_that_is_killed(self):
        intruder = self.start("intruder", "_agent:=" + AGENT, executable="controller_node")
        line = self.log.wait_for(lambda line: SENTENCE in line.msg, "the reason", self.log_start)
        self.assert_only_the_assistant_stands(line.header.stamp, "/intruder")
        intruder.send_signal(signal.SIGKILL)
        self.assert_follows()

    def test_a_publisher_that_falls_silent(self):
        publisher = rospy.Publisher(AGENT + "/cmd_vel", TwistStamped, queue_size=1)
        poll(publisher.get_num_connections, "a subscriber of the commands")
        since = rospy.Time.now()
        subscriber = rospy.Subscriber(
            "state", ObjectState, lambda s: publisher.publish(TwistStamped(header=s.header))
        )
        self.assert_only_the_assistant_stands(since, rospy.get_name())
        subscriber.unregister()
        self.assert_follows()


if __name__ == "__main__":
    run_tests("fault_publishers")
