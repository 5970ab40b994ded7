#!/usr/bin/env python3
"""Parameters changed while the nodes run take effect within a cycle and outlive a reset."""

import math
import unittest

import numpy as np
from dynamic_reconfigure.client import Client
from observed_run import (
    DEADLINE,
    Messages,
    call,
    observe_controllers,
    observe_states,
    poll,
    read_scenario,
    run_tests,
)
from rosgraph_msgs.msg import Log
from std_srvs.srv import SetBool, Trigger

from deformable_manipulation.ros.live_parameters import values_of
from deformable_manipulation.srv import Step

AGENT = "assistant_1"
CYCLES = 20


class LiveParametersTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scenario = read_scenario()
        cls.controller = Client(AGENT, timeout=DEADLINE)
        cls.simulator = Client("simulator", timeout=DEADLINE)
        cls.decisions = observe_controllers(cls.scenario)[AGENT]
        cls.states = observe_states()
        cls.decisions.wait_for_more(1)
        cls.start = cls.controller.get_configuration(DEADLINE)

    def setUp(self):
        self.addCleanup(self.restore)

    def restore(self):
        self.set(self.controller, **values_of(self.scenario))
        size = dict(zip("xyz", self.scenario.controller.perturbation))
        self.set(self.simulator, **{"perturbation_" + axis: x for axis, x in size.items()})
        self.decisions.wait_for_more(CYCLES)

    def set(self, client, **values):
        return client.update_configuration(values)

    def offset_of(self, decision):
        return decision.distance - decision.h_collision

    def reset(self):
        resets = self.states[-1].reset_count
        self.assertTrue(call("reset", Trigger).success)
        self.states.wait_for(lambda state: state.reset_count > resets, "a reset")
        return self.decisions.wait_for(
            lambda decision: decision.reset_count > resets and decision.cycle >= CYCLES, "decisions"
        )

    def test_they_begin_with_the_scenario(self):
        for name, value in values_of(self.scenario).items():
            self.assertEqual(self.start[name], value, name)
        simulator = self.simulator.get_configuration(DEADLINE)
        sizes = [simulator["perturbation_" + axis] for axis in "xyz"]
        self.assertEqual(sizes, list(self.scenario.controller.perturbation))

    def test_a_change_acts_on_the_next_cycle_and_outlives_a_reset(self):
        self.assertTrue(call("pause", SetBool, True).success)
        self.addCleanup(call, "pause", SetBool, False)
        last = self.decisions[-1]
        # While time stands still no cycle is under way: the next one is the first to know.
        result = self.set(self.controller, collision_offset=0.11)
        self.assertIn("collision_offset", result["outcome"])
        answered = self.decisions[-1]
        self.assertTrue(call("step", Step, 1).success)
        following = self.decisions.wait_for(
            lambda decision: (
                decision.cycle == answered.cycle + 1 and decision.header.stamp > last.header.stamp
            ),
            "the next cycle",
        )
        self.assertAlmostEqual(self.offset_of(following), 0.11)
        self.assertTrue(call("pause", SetBool, False).success)
        self.assertAlmostEqual(self.offset_of(self.reset()), 0.11)

    def test_limits_that_contradict_each_other_are_refused_with_the_reason(self):
        result = self.set(self.controller, max_distance=0.3, min_distance=0.5)
        self.assertIn("Nothing changed: controller.proximity.min_distance", result["outcome"])
        self.assertEqual(result["max_distance"], -1.0)
        self.assertEqual(result["min_distance"], -1.0)

    def test_values_out_of_range_are_refused_and_the_old_ones_stay(self):
        cases = [
            ("collision_offset", -1.0, "from 0 to 1, not -1.0"),
            ("max_velocity", 1e9, "from 0.001 to 2, not 1000000000.0"),
            ("gain", math.inf, "from 0.01 to 20, not inf"),
            ("max_distance", math.nan, "from -1 to 100, not nan"),
        ]
        for name, value, text in cases:
            with self.subTest(name):
                kept = values_of(self.scenario)[name]
                result = self.set(self.controller, **{name: value})
                self.assertEqual(result[name], kept)
                self.assertEqual(
                    result["outcome"],
                    f"Nothing changed: {name} must be a number {text}; it stays {kept:g}.",
                )
        result = self.set(self.controller, gain=2.0, smoothing=-0.5, weight_x=1e3)
        self.assertEqual(result["gain"], self.scenario.controller.gain)
        for name in ("smoothing", "weight_x"):
            self.assertIn(f"{name} must be", result["outcome"])
        following = self.decisions.wait_for_more(CYCLES)[-1]
        self.assertAlmostEqual(self.offset_of(following), self.scenario.controller.collision.offset)

    def test_a_refusal_is_an_error_in_the_log(self):
        log = Messages("/rosout", Log)
        for client, name in (
            (self.controller, "collision_offset"),
            (self.simulator, "perturbation_z"),
        ):

            def refusal_is_in_the_log(client=client, name=name):
                self.set(client, **{name: -5.0})  # again, until the node is connected
                return any(
                    entry.level == Log.ERROR and f"Nothing changed: {name} must" in entry.msg
                    for entry in list(log)
                )

            poll(refusal_is_in_the_log, "the refusal of " + name)

    def test_clients_learn_the_ranges(self):
        for client, name, ends in (
            (self.controller, "max_velocity", (0.001, 2.0)),
            (self.simulator, "perturbation_z", (-1.0, 1.0)),
        ):
            described = {entry["name"]: entry for entry in client.get_parameter_descriptions()}
            self.assertEqual((described[name]["min"], described[name]["max"]), ends)

    def test_perturbations_out_of_range_are_refused_and_the_old_ones_stay(self):
        kept = self.scenario.controller.perturbation[2]
        for value in (5.0, -1.5, math.inf, math.nan):
            with self.subTest(value):
                result = self.set(self.simulator, perturbation_z=value)
                self.assertEqual(result["perturbation_z"], kept)
                self.assertEqual(
                    result["outcome"],
                    "Nothing changed: perturbation_z must be a number from -1 to 1, "
                    f"not {value:g}; it stays {kept:g}.",
                )

    def test_perturbations_change_and_outlive_a_reset(self):
        result = self.set(self.simulator, perturbation_z=0.04)
        self.assertEqual(result["outcome"], "Changed.")

        def has_new_copies(state):
            sizes = np.abs(state.displacements.reshape(-1, 3)[1:])
            return all(state.copy_ready) and sizes.max(axis=0)[2] <= 0.04 + 1e-9

        self.states.wait_for(has_new_copies, "ready copies of the new size", len(self.states))
        resets = self.states[-1].reset_count
        self.reset()
        first = self.states.wait_for(lambda state: state.reset_count > resets, "a reset")
        self.assertEqual(first.cycle, 0)
        self.assertTrue(has_new_copies(first))

    def test_a_perturbation_of_nothing_is_refused(self):
        result = self.set(self.simulator, perturbation_x=0.0)
        self.assertIn("Nothing changed: every perturbation must be at least", result["outcome"])
        self.assertEqual(result["perturbation_x"], self.scenario.controller.perturbation[0])


if __name__ == "__main__":
    run_tests("live_parameters")
