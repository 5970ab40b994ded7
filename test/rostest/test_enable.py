#!/usr/bin/env python3
"""An assistant that is switched off answers with zero velocity, and follows once switched on."""

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
from std_srvs.srv import SetBool

from deformable_manipulation.control.status import Status
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
        cls.disabled = cls.decisions.wait_for_cycle(cls.scenario.cycles)

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

    def tearDown(self):
        self.enable(False)

    def test_it_stands_still_from_the_start_while_it_is_off(self):
        self.assertEqual([each.cycle for each in self.disabled], list(range(len(self.disabled))))
        self.assertEqual({each.status for each in self.disabled}, {int(Status.DISABLED)})
        self.assertFalse(any(each.enabled for each in self.disabled))
        self.assertFalse(any(command_of(each).any() for each in self.disabled))
        last = self.states.wait_for_cycle(self.scenario.cycles)[self.scenario.cycles]
        leader, assistant = (
            agent_positions(last, self.scenario)[index] - self.scenario.agents[index].start
            for index in (self.scenario.leader_index, self.assistant)
        )
        self.assertLess(leader[2], -0.4)
        self.assertEqual(assistant.tolist(), [0.0, 0.0, 0.0])

    def test_it_follows_once_it_is_on_and_stops_once_it_is_off(self):
        self.enable(True)
        following = self.wait_for_status(*FOLLOWING)
        self.decisions.wait_for(
            lambda decision: decision.error_norm < 0.6 * following.error_norm,
            "a smaller error",
            len(self.decisions),
        )
        self.enable(False)
        stopped = self.wait_for_status(Status.DISABLED)
        after = [each for each in self.decisions if each.cycle >= stopped.cycle]
        self.assertFalse(any(command_of(each).any() for each in after))
        # The command that answers a state acts from the next one on, so it shows after that.
        for state in self.states.wait_for_cycle(stopped.cycle + FURTHER):
            if state.cycle >= stopped.cycle + 2:
                self.assertFalse(velocities_of(state, self.scenario)[self.assistant].any())

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
