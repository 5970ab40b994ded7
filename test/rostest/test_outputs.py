#!/usr/bin/env python3
"""What the simulator tells about its agents: wrenches that carry the weight, poses, frames."""

import math
import unittest

import numpy as np
from geometry_msgs.msg import PoseStamped, WrenchStamped
from observed_run import Messages, observe_states, read_scenario, run_tests
from tf2_msgs.msg import TFMessage

from deformable_manipulation.ros.conversions import agent_order

PREFIX = "left/"


def vector(message):
    return np.array([message.x, message.y, message.z])


def quaternion(message):
    return np.array([message.x, message.y, message.z, message.w])


class OutputsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scenario = read_scenario()
        cls.names = [agent.name for agent in cls.scenario.agents]
        cls.states = observe_states()

    def state_of(self, stamp):
        return self.states.wait_for(lambda state: state.header.stamp == stamp, "the state of it")

    def test_the_wrenches_at_rest_carry_the_weight(self):
        wrenches = {
            name: Messages(name + "/wrench", WrenchStamped).wait_for_more(1)[0]
            for name in self.names
        }
        rope = self.scenario.object
        weight = (
            rope.density
            * math.pi
            * rope.radius**2
            * rope.length
            * np.array(self.scenario.simulation.gravity)
        )
        total = sum(vector(each.wrench.force) for each in wrenches.values())
        np.testing.assert_allclose(total, weight, 0.0, 1e-3 * np.linalg.norm(weight))
        for each in wrenches.values():
            self.assertEqual(each.header.frame_id, self.scenario.frame)
            self.assertLess(each.wrench.force.z, 0.0)
        # The rope pulls its ends towards each other.
        self.assertGreater(wrenches["leader"].wrench.force.y, 0.1)
        self.assertLess(wrenches["assistant_1"].wrench.force.y, -0.1)

    def test_the_poses_are_those_of_the_state(self):
        for name in self.names:
            pose = Messages(name + "/pose", PoseStamped).wait_for_more(1)[0]
            self.assertEqual(pose.header.frame_id, self.scenario.frame)
            state = self.state_of(pose.header.stamp)
            self.assert_pose(state, name, vector(pose.pose.position), pose.pose.orientation)

    def test_the_agents_have_frames_with_the_prefix(self):
        message = Messages("/tf", TFMessage).wait_for_more(1)[0]
        frames = {each.child_frame_id: each for each in message.transforms}
        self.assertEqual(set(frames), {PREFIX + name for name in self.names})
        for name in self.names:
            frame = frames[PREFIX + name]
            self.assertEqual(frame.header.frame_id, self.scenario.frame)
            self.assert_pose(
                self.state_of(frame.header.stamp),
                name,
                vector(frame.transform.translation),
                frame.transform.rotation,
            )

    def assert_pose(self, state, name, position, orientation):
        row = agent_order(state, self.scenario)[self.names.index(name)]
        np.testing.assert_allclose(position, state.agent_positions.reshape(-1, 3)[row], atol=1e-12)
        np.testing.assert_allclose(
            quaternion(orientation), state.agent_orientations.reshape(-1, 4)[row], atol=1e-9
        )


if __name__ == "__main__":
    run_tests("outputs")
