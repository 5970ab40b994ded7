#!/usr/bin/env python3
"""A grip of several vertices lets go and holds again by services."""

import unittest

import numpy as np
from observed_run import call, object_points, observe_states, read_scenario, run_tests
from std_srvs.srv import SetBool, Trigger

from deformable_manipulation.srv import HoldParticle, ReleaseParticle

AGENT = "assistant_1"


class BarServicesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scenario = read_scenario()
        cls.agent = next(each for each in cls.scenario.agents if each.name == AGENT)
        cls.states = observe_states()

    def setUp(self):
        before = self.states.wait_for_more(1)[0]
        self.assertTrue(call("reset", Trigger).success)
        self.states.wait_for(lambda state: state.reset_count > before.reset_count, "a reset")

    def next_state(self):
        """One published after this call."""
        return self.states.wait_for_more(2)[-1]

    def held(self):
        """All particles that the assistant holds."""
        state = self.next_state()
        index = list(state.agents).index(AGENT)
        further = zip(state.further_particles, state.further_agents)
        return [state.agent_particles[index], *(p for p, agent in further if agent == index)]

    def release(self):
        response = call("release", ReleaseParticle, AGENT)
        self.assertTrue(response.success, response.message)
        self.assertEqual(self.held(), [-1])

    def test_a_bar_lets_go_and_a_reset_holds_again(self):
        bar = list(self.agent.particles)
        self.assertEqual(self.held(), bar)
        before = object_points(self.next_state())[bar]
        self.release()
        self.states.wait_for(
            lambda state: (object_points(state)[bar, 2] < before[:, 2] - 0.1).all(), "a fall"
        )
        self.setUp()
        self.assertEqual(self.held(), bar)
        np.testing.assert_allclose(object_points(self.next_state())[bar], before, atol=1e-9)

    def test_a_bar_that_let_go_holds_again(self):
        """While time stands still, so that nothing falls."""
        bar = list(self.agent.particles)
        self.assertTrue(call("pause", SetBool, True).success)
        self.addCleanup(call, "pause", SetBool, False)
        for request in ((-1, "", []), (bar[0], "clamped", bar[1:3])):
            self.assertTrue(call("release", ReleaseParticle, AGENT).success)
            response = call("hold", HoldParticle, AGENT, *request)
            self.assertTrue(response.success, response.message)
            self.assertIn("particle 87 and", response.message)
        self.assertTrue(call("pause", SetBool, False).success)
        self.assertEqual(sorted(self.held()), sorted(bar[:3]))

    def test_grips_that_cannot_be_are_refused(self):
        self.release()
        for why, request in (
            ("leave them empty", (-1, "", [86])),
            ("must be clamped", (87, "pinned", [86])),
            ("there are particles 0 to 90", (87, "", [91])),
        ):
            with self.subTest(why=why):
                response = call("hold", HoldParticle, AGENT, *request)
                self.assertFalse(response.success, response.message)
                self.assertIn(why, response.message)
        self.assertEqual(self.held(), [-1])


if __name__ == "__main__":
    run_tests("object_services_bars")
