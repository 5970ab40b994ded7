#!/usr/bin/env python3
"""The simulator's services that change copies, holds and material while it runs."""

import unittest

import numpy as np
from geometry_msgs.msg import Vector3
from observed_run import call, object_points, observe_states, read_scenario, run_tests
from std_srvs.srv import Trigger

from deformable_manipulation.ros.conversions import agent_order
from deformable_manipulation.srv import (
    ClearPerturbations,
    HoldParticle,
    ReleaseParticle,
    SetMaterial,
    SetPerturbations,
)

AGENT = "assistant_1"
UP = Vector3(0.0, 0.0, 0.05)


def copies(state):
    """(agent, present displacement) of each perturbed copy."""
    names = [state.agents[index] for index in state.displaced_agents[1:]]
    return list(zip(names, state.displacements.reshape(-1, 3)[1:].round(9).tolist()))


def is_ready(state):
    return all(state.copy_ready)


class ObjectServicesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scenario = read_scenario()
        cls.states = observe_states()

    def setUp(self):
        before = self.states.wait_for_more(1)[0]
        self.assert_success("reset", Trigger)
        self.states.wait_for(
            lambda state: state.reset_count > before.reset_count and is_ready(state), "a reset"
        )

    def assert_success(self, service, *request):
        response = call(service, *request)
        self.assertTrue(response.success, response.message)
        self.assertTrue(response.message)

    def assert_refused(self, why, service, *request):
        response = call(service, *request)
        self.assertFalse(response.success, response.message)
        self.assertIn("Nothing changed: ", response.message)
        self.assertIn(why, response.message)

    def next_state(self):
        """One published after this call."""
        return self.states.wait_for_more(2)[-1]

    def wait_for(self, condition, what):
        return self.states.wait_for(condition, what, len(self.states))

    def held_particles(self):
        state = self.next_state()
        return state.agent_particles[agent_order(state, self.scenario)].tolist()

    def test_copies_are_added(self):
        before = copies(self.next_state())
        self.assertEqual(len(before), 6)
        self.assert_success("set_perturbations", SetPerturbations, [AGENT], [UP], False)
        added = before + [(AGENT, [0.0, 0.0, 0.05])]
        arrived = self.wait_for(lambda state: copies(state) == added, "a copy at its displacement")
        self.assertEqual(len(arrived.points), 8 * arrived.point_count * 3)
        self.wait_for(is_ready, "a copy that is ready")

    def test_copies_are_replaced(self):
        wanted = [("leader", [0.02, 0.0, 0.0]), (AGENT, [0.0, 0.0, 0.05])]
        self.assert_success(
            "set_perturbations",
            SetPerturbations,
            ["leader", AGENT],
            [Vector3(0.02, 0.0, 0.0), UP],
            True,
        )
        self.wait_for(lambda state: copies(state) == wanted, "exactly the new copies")

    def test_a_copy_s_held_point_is_displaced(self):
        self.assert_success("set_perturbations", SetPerturbations, [AGENT], [UP], True)
        state = self.wait_for(lambda state: len(copies(state)) == 1 and is_ready(state), "the copy")
        points = state.points.reshape(2, -1, 3)
        # The last segment is held at its centre, the first one by the leader, who is elsewhere.
        shift = points[1] - points[0]
        np.testing.assert_allclose(0.5 * (shift[-2] + shift[-1]), [0.0, 0.0, 0.05], atol=1e-9)
        np.testing.assert_allclose(0.5 * (shift[0] + shift[1]), 0.0, atol=1e-9)

    def test_wrong_copies_change_nothing(self):
        before = copies(self.next_state())
        for why, agents, displacements in (
            ("there is no agent 'assistant_7'; there are", [AGENT, "assistant_7"], [UP, UP]),
            ("same length", [AGENT, AGENT], [UP]),
            ("displacement", [AGENT, AGENT], [UP, Vector3(0.0, 0.0, 0.0)]),
            ("displacement", [AGENT, AGENT], [UP, Vector3(0.0, float("nan"), 0.0)]),
            ("displacement", [AGENT, AGENT], [UP, Vector3(0.0, 50.0, 0.0)]),
        ):
            for replace in (True, False):
                with self.subTest(why=why, replace=replace):
                    self.assert_refused(
                        why, "set_perturbations", SetPerturbations, agents, displacements, replace
                    )
                    self.assertEqual(copies(self.next_state()), before)

    def test_copies_of_an_agent_are_removed(self):
        self.assert_success("set_perturbations", SetPerturbations, ["leader"], [UP], False)
        self.assert_success("clear_perturbations", ClearPerturbations, [AGENT])
        self.wait_for(
            lambda state: copies(state) == [("leader", [0.0, 0.0, 0.05])], "the leader's copy alone"
        )

    def test_all_copies_are_removed(self):
        self.assert_success("clear_perturbations", ClearPerturbations, [])
        state = self.next_state()
        self.assertEqual(copies(state), [])
        self.assertEqual(len(state.points), state.point_count * 3)

    def test_unknown_agents_keep_all_copies(self):
        before = copies(self.next_state())
        self.assert_refused(
            "no agent 'nobody'", "clear_perturbations", ClearPerturbations, [AGENT, "nobody"]
        )
        self.assertEqual(copies(self.next_state()), before)

    def test_an_agent_lets_go_and_a_reset_holds_again(self):
        self.assertEqual(self.held_particles(), [0, 27])
        self.assert_success("release", ReleaseParticle, AGENT)
        self.assertEqual(self.held_particles(), [0, -1])
        state = self.wait_for(
            lambda state: object_points(state)[-1, 2] < 0.8, "the end of the rope falling"
        )
        self.assertEqual(copies(state), [])
        self.assert_refused("assistant_1 holds nothing", "release", ReleaseParticle, AGENT)
        self.assert_refused("away", "hold", HoldParticle, AGENT, -1, "", [])
        self.setUp()
        self.assertEqual(self.held_particles(), [0, 27])
        self.assertEqual(len(copies(self.next_state())), 6)

    def test_an_agent_that_holds_one_particle_grips_no_other(self):
        self.assert_refused("already", "hold", HoldParticle, AGENT, 26, "", [])
        self.assert_refused("it must be", "hold", HoldParticle, AGENT, 26, "glued", [])
        self.assert_refused("no agent 'nobody'", "hold", HoldParticle, "nobody", 26, "", [])
        self.assertEqual(self.held_particles(), [0, 27])

    def test_material(self):
        soft = object_points(self.next_state())[:, 2].min()
        for why, keys, values in (
            ("colour", ["young_modulus", "colour"], [3.0e9, 1.0]),
            ("torsion_modulus", ["young_modulus", "torsion_modulus"], [3.0e9, -1.0]),
            ("same length", ["young_modulus"], []),
        ):
            with self.subTest(why=why):
                self.assert_refused(why, "set_material", SetMaterial, keys, values)
        self.setUp()
        self.assertAlmostEqual(object_points(self.next_state())[:, 2].min(), soft, delta=1e-9)
        rope = self.scenario.object
        keys = ["young_modulus", "torsion_modulus"]
        self.assert_success("set_material", SetMaterial, keys, [3.0e10, 1.0e10])
        self.addCleanup(
            self.assert_success,
            "set_material",
            SetMaterial,
            keys,
            [rope.young_modulus, rope.torsion_modulus],
        )
        self.setUp()
        stiff = object_points(self.next_state())[:, 2].min()
        self.assertGreater(abs(stiff - soft), 0.002)


if __name__ == "__main__":
    run_tests("object_services")
