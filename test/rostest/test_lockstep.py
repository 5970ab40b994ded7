#!/usr/bin/env python3
"""A lock-step run is complete, safe, and the same as without ROS.

Parameters: ~cycles, how many are looked at.
"""

import unittest

import numpy as np
import rospy
from observed_run import (
    assert_same_positions,
    command_of,
    object_points,
    observe_controllers,
    observe_states,
    read_scenario,
    records_without_ros,
    run_tests,
    turning_of,
)

from deformable_manipulation.control.status import Status
from deformable_manipulation.distance.factory import make_minimum_distance
from deformable_manipulation.motion.obstacle_motion import MovingObstacles
from deformable_manipulation.msg import ObjectState

TOLERANCE = 1e-9  # m and m/s: rounding


class LockstepTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.cycles = rospy.get_param("~cycles")
        cls.scenario = read_scenario()
        cls.controllers = observe_controllers(cls.scenario)
        states = observe_states()
        cls.states = states.wait_for_cycle(cls.cycles - 1)[: cls.cycles]
        cls.records = records_without_ros(cls.scenario, cls.cycles)

    def test_every_state_comes_in_order(self):
        self.assertEqual([state.cycle for state in self.states], list(range(self.cycles)))
        self.assertEqual({state.reset_count for state in self.states}, {0})
        stamps = [state.header.stamp.to_sec() for state in self.states]
        np.testing.assert_allclose(np.diff(stamps), self.scenario.cycle_time, 0.0, 1e-8)

    def test_the_state_tells_what_is_carried(self):
        is_fabric = self.scenario.object.type == "fabric"
        state = self.states[0]
        self.assertEqual(state.object_type, ObjectState.FABRIC if is_fabric else ObjectState.ROD)
        self.assertEqual(state.particle_count, self.scenario.object.particles)
        self.assertEqual(state.point_count, state.particle_count + (not is_fabric))
        self.assertEqual(len(state.orientations), 0 if is_fabric else 4 * state.particle_count)
        held = {name: [each] for name, each in zip(state.agents, state.agent_particles)}
        for particle, index in zip(state.further_particles, state.further_agents):
            held[state.agents[index]].append(particle)
        agents = self.scenario.agents
        self.assertEqual(held, {agent.name: list(agent.particles) for agent in agents})

    def test_the_object_keeps_its_distance(self):
        distance, obstacles = make_minimum_distance(self.scenario), MovingObstacles(self.scenario)
        lowest = np.inf
        for state in self.states:
            obstacles.move(distance, state.cycle * self.scenario.cycle_time)
            lowest = min(lowest, distance.compute(object_points(state)[None]).minimum[0])
        offset = self.scenario.controller.collision.offset
        self.assertGreaterEqual(lowest, offset - 0.001)
        # It comes near, or nothing would be shown.
        self.assertLess(lowest, offset + rospy.get_param("~near", 0.02))

    def test_gradients_come_from_where_the_scenario_says(self):
        exact = self.scenario.controller.jacobian == "equilibrium"
        for name, controller in self.controllers.items():
            decisions = controller.wait_for_cycle(self.cycles - 1)[: self.cycles]
            # Until a camera's first image has come, there is nothing to decide on.
            known = [each for each in decisions if each.status != Status.WAITING]
            self.assertGreaterEqual(len(known), self.cycles - 1)
            self.assertEqual({each.exact_jacobian for each in known}, {exact}, name)

    def test_the_positions_are_those_without_ros(self):
        assert_same_positions(self.states, self.records, self.scenario, TOLERANCE)

    def test_the_decisions_are_those_without_ros(self):
        for name, controller in self.controllers.items():
            decisions = controller.wait_for_cycle(self.cycles - 1)[: self.cycles]
            self.assertEqual([each.cycle for each in decisions], list(range(self.cycles)))
            for decision, record in zip(decisions, self.records):
                expected = record.decisions[name]
                where = "{} in cycle {}".format(name, record.cycle)
                np.testing.assert_allclose(
                    command_of(decision), expected.command, 0.0, TOLERANCE, err_msg=where
                )
                np.testing.assert_allclose(
                    turning_of(decision), expected.angular_command, 0.0, TOLERANCE, err_msg=where
                )
                self.assertEqual(list(decision.barriers), list(expected.h), where)
                np.testing.assert_allclose(
                    decision.h, list(expected.h.values()), 0.0, 1e-6, err_msg=where
                )
                self.assertEqual(decision.status, expected.status, where)
                self.assertEqual(decision.exact_jacobian, expected.exact_jacobian, where)
                np.testing.assert_allclose(
                    decision.distance, expected.distance, 0.0, TOLERANCE, err_msg=where
                )


if __name__ == "__main__":
    run_tests("lockstep")
