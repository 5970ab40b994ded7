#!/usr/bin/env python3
"""Switched off, an assistant stands still, and its leader waits; switched on, it follows."""

import unittest

import numpy as np
from geometry_msgs.msg import Vector3
from observed_run import (
    call,
    command_of,
    observe_controllers,
    observe_states,
    read_scenario,
    run_tests,
    velocities_of,
)
from std_srvs.srv import SetBool, Trigger

from deformable_manipulation.control.status import Status
from deformable_manipulation.motion.leader import LeaderPath
from deformable_manipulation.ros.conversions import agent_positions
from deformable_manipulation.srv import ClearPerturbations, SetPerturbations

AGENT = "assistant_1"
FOLLOWING = (Status.NOMINAL, Status.CONSTRAINED)
FURTHER = 20  # cycles


class EnableTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scenario = read_scenario()
        (cls.assistant,) = cls.scenario.assistants
        cls.decisions = observe_controllers(cls.scenario)[AGENT]
        cls.states = observe_states()

    def setUp(self):
        """The assistant is off and at rest, and the leader waits for it at its start."""
        self.enable(False)
        self.decisions.wait_for(
            lambda decision: decision.status == Status.DISABLED and not command_of(decision).any(),
            "an assistant at rest",
            len(self.decisions),
        )
        resets = self.states[-1].reset_count if self.states else 0
        self.assertTrue(call("reset", Trigger).success)
        self.states.wait_for(lambda state: state.reset_count > resets, "a reset")
        self.first = self.decisions.wait_for(
            lambda decision: decision.reset_count > resets, "a decision after the reset"
        )

    def since_reset(self, messages):
        return [each for each in messages if each.reset_count == self.first.reset_count]

    def enable(self, enabled):
        response = call(AGENT + "/enable", SetBool, enabled)
        self.assertTrue(response.success, response.message)

    def wait_for_status(self, *allowed):
        """The first of at least some answers with one of these statuses in a row."""
        first = self.decisions.wait_for(
            lambda decision: decision.status in allowed, str(allowed), len(self.decisions)
        )
        for decision in self.decisions.wait_for_more(FURTHER):
            self.assertIn(decision.status, allowed, decision.status_text)
        return first

    def way(self, state, agent):
        """How far (3,) [m] an agent is from its start."""
        start = self.scenario.agents[agent].start
        return agent_positions(state, self.scenario)[agent] - start

    def wait_for_leader_below(self, height):
        """Wait until the leader is lower than a height [m] relative to its start."""
        leader = self.scenario.leader_index
        self.states.wait_for(
            lambda state: (
                state.reset_count == self.first.reset_count and self.way(state, leader)[2] < height
            ),
            "a leader on its way",
        )

    def test_both_stand_still_while_it_is_off(self):
        last = self.states.wait_for_cycle(self.scenario.cycles, self.first.reset_count)[-1]
        for agent in (self.scenario.leader_index, self.assistant):
            self.assertEqual(self.way(last, agent).tolist(), [0.0, 0.0, 0.0])
        disabled = self.since_reset(self.decisions)
        self.assertEqual([each.cycle for each in disabled], list(range(len(disabled))))
        self.assertEqual({each.status for each in disabled}, {int(Status.DISABLED)})
        self.assertFalse(any(each.enabled for each in disabled))
        self.assertFalse(any(command_of(each).any() for each in disabled))

    def test_the_leader_starts_its_path_when_it_is_told_to(self):
        response = call("leader/start", Trigger)
        self.assertTrue(response.success, response.message)
        self.wait_for_leader_below(-0.1)
        response = call("leader/start", Trigger)
        self.assertFalse(response.success)
        self.assertIn("on its path already", response.message)

    def test_the_leader_starts_its_path_from_the_beginning_when_it_is_on(self):
        self.states.wait_for_cycle(self.scenario.cycles // 2, self.first.reset_count)
        self.enable(True)
        self.wait_for_leader_below(-0.1)
        path = LeaderPath(self.scenario.leader.waypoints)
        on_path = [
            state
            for state in self.since_reset(list(self.states))
            if self.way(state, self.scenario.leader_index)[2] < 0.0
        ]
        # The command for the first cycle of the path acts in the state after the next.
        for index, state in enumerate(on_path):
            np.testing.assert_allclose(
                self.way(state, self.scenario.leader_index),
                path.at((index + 2) * self.scenario.cycle_time),
                0.0,
                1e-9,
            )

    def test_it_follows_once_it_is_on_and_stops_once_it_is_off(self):
        self.enable(True)
        self.wait_for_status(*FOLLOWING)
        self.enable(False)
        self.wait_for_status(Status.DISABLED)
        stopped = self.decisions.wait_for(  # after it has slowed down
            lambda decision: not command_of(decision).any(), "rest", len(self.decisions)
        )
        after = [each for each in self.since_reset(self.decisions) if each.cycle >= stopped.cycle]
        self.assertFalse(any(command_of(each).any() for each in after))
        # The command that answers a state acts from the next one on, so it shows after that.
        for state in self.states.wait_for_cycle(stopped.cycle + FURTHER, self.first.reset_count):
            if state.reset_count == self.first.reset_count and state.cycle >= stopped.cycle + 2:
                self.assertFalse(velocities_of(state, self.scenario)[self.assistant].any())

    def test_it_makes_up_for_what_it_missed_while_it_was_off(self):
        self.assertTrue(call("leader/start", Trigger).success)
        self.wait_for_leader_below(-0.4)
        self.enable(True)
        following = self.wait_for_status(*FOLLOWING)
        self.assertGreater(following.error_norm, 0.3)
        # As far as the ground allows, which depends on how low the leader was by then.
        self.states.wait_for(
            lambda state: (
                state.reset_count == self.first.reset_count
                and self.way(state, self.assistant)[2] < -0.1
            ),
            "an assistant that catches up",
        )

    def test_it_waits_without_copies_and_goes_on_with_new_ones(self):
        self.enable(True)
        self.wait_for_status(*FOLLOWING)
        self.assertTrue(call("clear_perturbations", ClearPerturbations, []).success)
        self.decisions.wait_for(
            lambda decision: decision.status == Status.WAITING, "a stop", len(self.decisions)
        )
        for decision in self.decisions.wait_for_more(FURTHER):
            self.assertEqual(decision.status, Status.WAITING)
            self.assertIn("perturbed copies", decision.status_text)
            self.assertFalse(command_of(decision).any())
        displacements = [Vector3(*row) for row in np.vstack((np.eye(3), -np.eye(3))) * 0.1]
        added = call("set_perturbations", SetPerturbations, [AGENT] * 6, displacements, True)
        self.assertTrue(added.success, added.message)
        self.wait_for_status(*FOLLOWING)


if __name__ == "__main__":
    run_tests("enable")
