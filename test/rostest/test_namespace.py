#!/usr/bin/env python3
"""A run in a namespace keeps to it."""

import unittest

import rospy
from observed_run import (
    assert_same_positions,
    observe_controllers,
    observe_states,
    read_scenario,
    records_without_ros,
    run_tests,
)

CYCLES = 50
OF_ROS_ITSELF = {"/clock", "/diagnostics", "/rosout", "/rosout_agg", "/tf"}


class NamespaceTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scenario = read_scenario()
        cls.controllers = observe_controllers(cls.scenario)
        cls.states = observe_states().wait_for_cycle(CYCLES - 1)[:CYCLES]

    def test_the_run_is_the_same(self):
        records = records_without_ros(self.scenario, CYCLES)
        assert_same_positions(self.states, records, self.scenario, 1e-9)
        for messages in self.controllers.values():
            messages.wait_for_cycle(CYCLES - 1)

    def test_all_topics_are_in_the_namespace(self):
        namespace = rospy.get_namespace()
        self.assertNotEqual(namespace, "/")
        names = {name for name, _ in rospy.get_published_topics()} - OF_ROS_ITSELF
        self.assertIn(namespace + "state", names)
        self.assertEqual([name for name in names if not name.startswith(namespace)], [])

    def test_the_scenario_is_in_the_namespace(self):
        self.assertTrue(rospy.has_param(rospy.get_namespace() + "scenario"))
        self.assertFalse(rospy.has_param("/scenario"))


if __name__ == "__main__":
    run_tests("namespace")
