#!/usr/bin/env python3
"""An assistant whose force sensor disagrees with the model stops until it is enabled again."""

import copy
import unittest

import rospy
from geometry_msgs.msg import WrenchStamped
from observed_run import call, observe_controllers, observe_states, read_scenario, run_tests
from std_srvs.srv import SetBool

from deformable_manipulation.control.status import Status

AGENT = "assistant_1"
FURTHER = 50  # cycles, more than the watch has patience


class WrenchWatchTest(unittest.TestCase):
    def setUp(self):
        self.decisions = observe_controllers(read_scenario())[AGENT]
        self.states = observe_states()
        self.sensor = rospy.Publisher(AGENT + "/measured_wrench", WrenchStamped, queue_size=10)

    def wait_for(self, wanted, what):
        return self.decisions.wait_for(wanted, what, len(self.decisions))

    def measure(self, wrench, newton):
        measured = copy.deepcopy(wrench)
        measured.wrench.force.x += newton
        measured.header.stamp = self.states[-1].header.stamp
        self.sensor.publish(measured)

    def test_it_stops_and_goes_on(self):
        decision = self.wait_for(lambda each: each.status == Status.WAITING, "a sensor")
        self.assertIn("no measured wrench of assistant_1 yet", decision.status_text)
        modelled = rospy.wait_for_message(AGENT + "/wrench", WrenchStamped)
        while not self.sensor.get_num_connections() and not rospy.is_shutdown():
            self.decisions.wait_for_cycle(self.decisions[-1].cycle + 1)

        self.measure(modelled, 0.5)
        self.wait_for(lambda each: each.status == Status.NOMINAL, "a sensor that agrees")

        self.measure(modelled, 4.0)
        decision = self.wait_for(lambda each: each.status == Status.WAITING, "a stop")
        self.assertIn("differs from the modelled one by 4 N", decision.status_text)

        self.measure(modelled, 0.0)
        last = self.decisions[-1].cycle
        self.decisions.wait_for_cycle(last + FURTHER)
        since = [each for each in self.decisions if each.cycle > last]
        self.assertEqual({each.status for each in since}, {Status.WAITING})

        self.assertTrue(call(AGENT + "/enable", SetBool, True).success)
        self.wait_for(lambda each: each.status == Status.NOMINAL, "an assistant that goes on")


if __name__ == "__main__":
    run_tests("wrench_watch")
