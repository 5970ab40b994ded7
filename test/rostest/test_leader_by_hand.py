#!/usr/bin/env python3
"""The leader is dragged by its interactive marker, and steered by a velocity; the marker's menu."""

import math
import unittest

import numpy as np
import rospy
from geometry_msgs.msg import Twist
from marker_hand import MarkerHand
from observed_run import (
    Messages,
    call,
    observe_controllers,
    observe_states,
    poll,
    read_scenario,
    run_tests,
    velocities_of,
)
from rosgraph_msgs.msg import Log
from std_srvs.srv import SetBool, Trigger
from visualization_msgs.msg import InteractiveMarkerInit, InteractiveMarkerUpdate

from deformable_manipulation.ros.conversions import agent_positions
from deformable_manipulation.scenario import leader_workspace
from deformable_manipulation.srv import Step

AGENT = "assistant_1"
ROUNDING = 1e-9
NEAR = 1e-6  # m
CYCLES = 50  # at rest in a row


class LeaderByHandTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scenario = read_scenario()
        cls.row = cls.scenario.leader_index
        cls.hand = MarkerHand("leader")
        cls.teleop = rospy.Publisher("leader/teleop", Twist, queue_size=100)
        poll(cls.teleop.get_num_connections, "the leader")
        cls.log = Messages("/rosout", Log)
        cls.markers = Messages("interactive_markers/update_full", InteractiveMarkerInit)
        cls.updates = Messages("interactive_markers/update", InteractiveMarkerUpdate)
        cls.decisions = observe_controllers(cls.scenario)[AGENT]
        cls.states = observe_states(cls.hand.on_state)

    def setUp(self):
        self.hand.act = None
        resets = self.states[-1].reset_count if self.states else 0
        call("reset", Trigger)
        self.start = np.array(self.scenario.agents[self.row].start)
        self.states.wait_for(
            lambda state: (
                state.reset_count > resets and np.array_equal(self.position(state), self.start)
            ),
            "the start",
        )

    def tearDown(self):
        self.hand.act = None

    def position(self, state):
        return agent_positions(state, self.scenario)[self.row]

    def velocity(self, state):
        return velocities_of(state, self.scenario)[self.row]

    def steer(self, velocity):
        twist = Twist()
        twist.linear.x, twist.linear.y, twist.linear.z = velocity
        self.hand.act = lambda: self.teleop.publish(twist)

    def wait_for_rest(self):
        """The position at which the leader comes to rest."""
        row = []

        def rests(state):
            row.append(state)
            if self.velocity(state).any():
                row.clear()
            return len(row) >= CYCLES

        return self.position(self.states.wait_for(rests, "a leader at rest", len(self.states)))

    def wait_for_place(self, expected):
        self.states.wait_for(
            lambda state: abs(self.position(state) - expected).max() < NEAR,
            "the leader at {}".format(expected),
            len(self.states),
        )

    def assert_within_limits(self, states):
        """All along these states, one after the other."""
        limits = self.scenario.leader
        velocities = np.array([self.velocity(state) for state in states])
        self.assertLessEqual(np.abs(velocities).max(), limits.max_velocity + ROUNDING)
        change = np.abs(np.diff(velocities, axis=0)).max() / self.scenario.cycle_time
        self.assertLessEqual(change, limits.max_acceleration + 1e-6)

    def test_it_goes_where_the_marker_is_dragged_and_the_marker_stays_with_it(self):
        first = len(self.states)
        target = self.start + (0.1, -0.05, 0.02)
        self.hand.drag(target)
        self.wait_for_place(target)
        self.hand.release(target)
        self.assert_within_limits(self.states[first:])
        place = self.wait_for_rest()
        np.testing.assert_allclose(place, target, 0.0, NEAR)
        self.wait_for_marker(place)

    def wait_for_marker(self, place):
        """The newest of all places of the marker that were sent is this one."""

        def is_there():
            poses = [pose for update in list(self.updates) for pose in update.poses]
            if not poses:
                return False
            at = poses[-1].pose.position
            return max(abs(np.array((at.x, at.y, at.z)) - place)) < 1e-3

        poll(is_there, "the marker at the leader")

    def test_let_go_on_the_way_it_stops_and_the_marker_comes_back(self):
        far = self.start + (0.0, 0.4, 0.0)
        for is_told in (True, False):
            with self.subTest(is_told=is_told):
                self.hand.drag(far)
                self.states.wait_for(
                    lambda state: self.velocity(state)[1] > 0.05, "motion", len(self.states)
                )
                if is_told:
                    self.hand.release(far)
                self.hand.act = None
                place = self.wait_for_rest()
                if is_told:
                    self.assertLess(place[1], far[1] - 0.01)
                self.wait_for_marker(place)

    def test_it_stays_in_the_workspace(self):
        lower, upper = leader_workspace(self.scenario)
        first = len(self.states)
        self.hand.drag((100.0, lower[1] - 0.01, self.start[2]))
        wall = np.array((upper[0], lower[1], self.start[2]))
        self.wait_for_place(wall)
        np.testing.assert_allclose(self.wait_for_rest(), wall, 0.0, NEAR)
        places = np.array([self.position(state) for state in self.states[first:]])
        self.assertTrue((places <= np.array(upper) + ROUNDING).all())
        self.assertTrue((places >= np.array(lower) - ROUNDING).all())
        self.assert_within_limits(self.states[first:])

    def test_what_cannot_be_meant_is_refused_and_told(self):
        for position, frame, word in (
            ((math.nan, 0.0, 1.0), "map", "three finite numbers"),
            ((0.1, 0.0, 1.35), "odom", "frame 'odom'"),
        ):
            with self.subTest(word=word):
                log_start = len(self.log)
                self.hand.drag(position, frame)
                self.log.wait_for(lambda line, w=word: w in line.msg, word, log_start)
                np.testing.assert_array_equal(self.wait_for_rest(), self.start)
                self.wait_for_marker(self.start)
        self.steer((0.0, math.nan, 0.0))
        self.log.wait_for(lambda line: "teleoperation command is ignored" in line.msg, "a refusal")
        np.testing.assert_array_equal(self.wait_for_rest(), self.start)

    def test_it_is_steered_until_no_more_commands_come(self):
        first = len(self.states)
        self.steer((0.0, 0.05, 0.0))
        self.states.wait_for(
            lambda state: abs(self.velocity(state) - (0.0, 0.05, 0.0)).max() < ROUNDING,
            "the velocity commanded",
            len(self.states),
        )
        self.hand.act = None
        place = self.wait_for_rest()
        self.assertGreater(place[1], self.start[1])
        self.assert_within_limits(self.states[first:])

    def select(self, *titles):
        """Choose an entry of the menu by its title and those of the menus above it."""
        entries = self.markers.wait_for(lambda init: init.markers, "a marker").markers[0]
        parent = 0
        for title in titles:
            (parent,) = [
                each.id
                for each in entries.menu_entries
                if (each.parent_id, each.title) == (parent, title)
            ]
        self.hand.select(parent)

    def test_the_menu_starts_and_stops_an_assistant(self):
        for title, enabled in (("Stop", False), ("Start", True)):
            self.select(AGENT, title)
            self.decisions.wait_for(
                lambda decision, e=enabled: decision.enabled == e, title, len(self.decisions)
            )

    def test_the_menu_takes_the_present_place_as_the_one_to_keep(self):
        self.assertTrue(call(AGENT + "/enable", SetBool, False).success)
        self.addCleanup(call, AGENT + "/enable", SetBool, True)
        self.hand.drag(self.start + (0.0, -0.1, 0.0))
        self.wait_for_place(self.start + (0.0, -0.1, 0.0))
        self.decisions.wait_for(
            lambda decision: abs(decision.error_norm - 0.1) < 1e-3, "an error", len(self.decisions)
        )
        self.select(AGENT, "Keep the current place")
        self.decisions.wait_for(
            lambda decision: decision.error_norm < 1e-3, "no error", len(self.decisions)
        )

    def test_the_menu_stops_time_and_sets_it_back(self):
        self.select("Pause")
        poll(lambda: call("step", Step, 1).success, "a pause")  # only a paused run makes steps
        resets = self.states[-1].reset_count
        self.select("Reset")
        self.states.wait_for(lambda state: state.reset_count > resets, "a reset")
        self.assertTrue(call("step", Step, 1).success)
        self.select("Continue")
        self.states.wait_for(
            lambda state: state.reset_count > resets and state.cycle > CYCLES, "further cycles"
        )
        self.assertFalse(call("step", Step, 1).success)


if __name__ == "__main__":
    run_tests("leader_by_hand")
