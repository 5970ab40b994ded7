#!/usr/bin/env python3
"""Services called with nonsense, or at the wrong time, in a run: it goes on as it is."""

from faulty_run import AGENT, FaultTest, process_of
from geometry_msgs.msg import Vector3
from observed_run import call, object_points, poll, run_tests
from std_srvs.srv import SetBool, Trigger

from deformable_manipulation.control.status import Status
from deformable_manipulation.srv import (
    ClearPerturbations,
    HoldParticle,
    ReleaseParticle,
    SetMaterial,
    SetPerturbations,
    Step,
)

NAN = float("nan")
INFINITY = float("inf")
UP = Vector3(0.0, 0.0, 0.05)
NONSENSE = (
    ("no agent ''", "release", ReleaseParticle, [""]),
    ("no agent", "release", ReleaseParticle, ["Assistant_1"]),
    ("already", "hold", HoldParticle, [AGENT, 5, "", []]),
    ("already", "hold", HoldParticle, [AGENT, 2147483647, "", []]),
    ("hold is", "hold", HoldParticle, [AGENT, -1, "CLAMPED", []]),
    ("no agent", "hold", HoldParticle, ["", -7, "", []]),
    ("same length", "set_material", SetMaterial, [[], []]),
    ("young_modulus", "set_material", SetMaterial, [["young_modulus"], [NAN]]),
    ("young_modulus", "set_material", SetMaterial, [["young_modulus"], [INFINITY]]),
    ("damping", "set_material", SetMaterial, [["damping"], [-1.0]]),
    ("must be young_modulus", "set_material", SetMaterial, [[""], [1.0]]),
    (
        "displacement",
        "set_perturbations",
        SetPerturbations,
        [[AGENT], [Vector3(INFINITY, 0.0, 0.0)], True],
    ),
    ("same length", "set_perturbations", SetPerturbations, [[], [UP], True]),
    ("no agent", "clear_perturbations", ClearPerturbations, [[""]]),
    ("not paused", "step", Step, [10]),
)


class FaultServicesTest(FaultTest):
    def assert_refused(self, why, service, service_class, request):
        response = call(service, service_class, *request)
        self.assertFalse(response.success, response.message)
        self.assertIn("Nothing changed: ", response.message)
        self.assertIn(why, response.message)

    def structure(self, state):
        """What the services could have changed."""
        return (
            state.agent_particles.tolist(),
            state.displaced_agents.tolist(),
            state.displacements.round(9).tolist(),
            state.reset_count,
        )

    def test_nonsense_changes_nothing(self):
        start = len(self.states) - 1
        for why, service, service_class, request in NONSENSE:
            with self.subTest(service=service, request=request):
                self.assert_refused(why, service, service_class, request)
        self.states.wait_for_more(2)
        states = self.states[start:]
        before = self.structure(states[0])
        for state in states:
            self.assertEqual(self.structure(state), before)
        cycles = [state.cycle for state in states]
        self.assertEqual(cycles, list(range(cycles[0], cycles[0] + len(cycles))))
        self.assert_follows()

    def test_a_controller_without_states(self):
        self.start(
            "lonely",
            "_agent:=" + AGENT,
            "_enabled:=false",
            "state:=nothing",
            "distances:=nothing",
            "{0}/enable:=lonely/enable".format(AGENT),
            "{0}/take_reference:=lonely/take_reference".format(AGENT),
            "{0}/cmd_vel:=lonely/cmd_vel".format(AGENT),
            "{0}/controller_state:=lonely/controller_state".format(AGENT),
            executable="controller_node",
        )
        poll(lambda: process_of("lonely"), "the controller without states")
        self.assert_refused("no state", "lonely/take_reference", Trigger, [])
        self.assert_refused("no state", "lonely/enable", SetBool, [True])
        self.assertTrue(call("lonely/enable", SetBool, False).success)

    def test_a_controller_whose_states_have_stopped(self):
        self.assertTrue(call("pause", SetBool, True).success)
        self.addCleanup(call, "pause", SetBool, False)
        self.assert_waits("no state for")
        self.assert_refused("no state", AGENT + "/take_reference", Trigger, [])
        self.assertTrue(call(AGENT + "/enable", SetBool, False).success)
        self.assert_refused("no state", AGENT + "/enable", SetBool, [True])
        call("pause", SetBool, False)
        self.decisions.wait_for(
            lambda decision: decision.status == Status.DISABLED, "an answer", len(self.decisions)
        )
        self.assertTrue(call(AGENT + "/enable", SetBool, True).success)
        self.assert_follows()

    def test_pause_step_and_resume(self):
        self.assertTrue(call("pause", SetBool, True).success)
        self.addCleanup(call, "pause", SetBool, False)
        self.assert_waits("no state for")
        paused, count = self.states[-1], len(self.states)
        self.assertTrue(call("step", Step, 5).success)
        self.states.wait_for(
            lambda state: state.cycle == paused.cycle + 5, "the fifth cycle", count
        )
        self.assert_waits("no state for")
        self.assertEqual(self.states[-1].cycle, paused.cycle + 5)
        self.assertTrue(call("pause", SetBool, False).success)
        self.assert_follows()

    def test_release_and_hold(self):
        self.assertTrue(call("release", ReleaseParticle, AGENT).success)
        self.assert_waits("has no ready perturbed copies")
        self.states.wait_for(
            lambda state: not self.velocity(state).any(), "a stop", len(self.states)
        )
        fallen = self.states[-1].agent_positions.reshape(-1, 3)[:, 2].min() - 0.2
        self.states.wait_for(
            lambda state: object_points(state)[-1, 2] < fallen, "a fallen end", len(self.states)
        )
        self.assert_refused("away", "hold", HoldParticle, [AGENT, -1, "", []])
        self.assertTrue(call("reset", Trigger).success)
        self.assert_follows()

    def test_release_and_hold_another_particle_while_paused(self):
        self.assertTrue(call("pause", SetBool, True).success)
        self.addCleanup(call, "pause", SetBool, False)
        self.assertTrue(call("release", ReleaseParticle, AGENT).success)
        response = call("hold", HoldParticle, AGENT, 26, "pinned", [])
        self.assertTrue(response.success, response.message)
        self.assertTrue(call("pause", SetBool, False).success)
        self.states.wait_for(
            lambda state: state.agent_particles[list(state.agents).index(AGENT)] == 26,
            "the new grip",
            len(self.states),
        )
        self.assert_follows()


if __name__ == "__main__":
    run_tests("fault_services")
