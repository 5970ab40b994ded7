#!/usr/bin/env python3
"""Reset repeats a run; pause and step stop time and let it go on."""

import unittest

import numpy as np
from observed_run import call, object_points, observe_states, read_scenario, run_tests
from std_srvs.srv import SetBool, Trigger

from deformable_manipulation.ros.conversions import agent_positions
from deformable_manipulation.srv import Step

CYCLES = 400
ROUNDING = 1e-9  # m


class ResetTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scenario = read_scenario()
        cls.states = observe_states()
        cls.states.wait_for_cycle(CYCLES - 1)

    def reset(self):
        """Reset; returns how many resets there have been."""
        resets = self.states[-1].reset_count
        response = call("reset", Trigger)
        self.assertTrue(response.success, response.message)
        return self.states.wait_for(
            lambda state: state.reset_count > resets, "a reset state"
        ).reset_count

    def test_a_reset_repeats_the_run(self):
        first = self.states[:CYCLES]
        resets = self.reset()
        states = self.states.wait_for_cycle(CYCLES - 1, resets)
        again = [state for state in states if state.reset_count == resets][:CYCLES]
        self.assertEqual([state.cycle for state in again], list(range(CYCLES)))
        for before, after in zip(first, again):
            self.assertEqual(before.cycle, after.cycle)
            self.assertGreater(after.header.stamp, before.header.stamp)
            for read in (object_points, lambda state: agent_positions(state, self.scenario)):
                np.testing.assert_allclose(read(after), read(before), 0.0, ROUNDING)

    def test_a_step_needs_a_pause(self):
        response = call("step", Step, 1)
        self.assertFalse(response.success)
        self.assertIn("not paused", response.message)

    def test_pause_and_step(self):
        self.assertTrue(call("pause", SetBool, True).success)
        self.addCleanup(call, "pause", SetBool, False)
        # The state is latched: who subscribes now gets the one at which time stands still.
        paused = self.latched_state()
        self.assertTrue(call("step", Step, 5).success)
        fifth = self.states.wait_for(
            lambda state: (
                state.header.stamp > paused.header.stamp and state.cycle == paused.cycle + 5
            ),
            "the fifth cycle",
        )
        self.assertEqual(self.latched_state().header.stamp, fifth.header.stamp)
        self.assertTrue(call("step", Step, 0).success)
        self.states.wait_for(
            lambda state: (
                state.header.stamp > fifth.header.stamp and state.cycle == fifth.cycle + 1
            ),
            "one more cycle",
        )

    def test_a_paused_run_can_be_reset(self):
        self.assertTrue(call("pause", SetBool, True).success)
        self.addCleanup(call, "pause", SetBool, False)
        resets = self.reset()
        self.assertEqual(self.latched_state().cycle, 0)
        self.assertEqual(self.latched_state().reset_count, resets)

    def latched_state(self):
        messages = observe_states()
        return messages.wait_for(lambda state: True, "the latched state")


if __name__ == "__main__":
    run_tests("reset")
