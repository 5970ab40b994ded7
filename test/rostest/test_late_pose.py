#!/usr/bin/env python3
"""An assistant whose poses come long after the start: it is named, and the leader waits for it.

The test publishes the pose.
"""

import unittest

import numpy as np
from diagnostic_msgs.msg import DiagnosticArray
from observed_run import Messages, call, observe_states, read_scenario, run_tests, velocities_of
from std_msgs.msg import Bool
from std_srvs.srv import SetBool, Trigger
from walking_pose import WalkingPose

from deformable_manipulation.motion.leader import LeaderPath
from deformable_manipulation.ros.conversions import agent_positions

AGENT = "assistant_1"
SECONDS = 3  # without a pose
CYCLES = 300  # to look at


class LatePoseTest(unittest.TestCase):
    def test_the_leader_waits_for_the_pose_of_its_assistant(self):
        scenario = read_scenario()
        leader, (assistant,) = scenario.leader_index, scenario.assistants
        for service, request in (("enable", (SetBool, True)), ("take_reference", (Trigger,))):
            response = call(f"{AGENT}/{service}", *request)
            self.assertFalse(response.success)
            self.assertEqual(
                response.message,
                "Nothing changed: the simulator waits for the pose of assistant_1 on "
                "/assistant_1/pose.",
            )
        Messages("/diagnostics", DiagnosticArray).wait_for(
            SeveralOf("simulator: agents", SECONDS), "diagnostics"
        )
        start = scenario.agents[assistant].start
        WalkingPose(f"{AGENT}/pose", start, (0.0, 0.0, 0.0), scenario.object.pose.orientation)
        following = Messages(f"{AGENT}/following", Bool)
        states = observe_states()
        first = states.wait_for(lambda state: True, "a state")
        self.assertGreater(first.cycle, 100)
        following.wait_for(lambda message: message.data, "an assistant that follows")
        seen = states.wait_for_cycle(first.cycle + CYCLES)
        position = agent_positions(seen[-1], scenario)[leader] - scenario.agents[leader].start
        behind = LeaderPath(scenario.leader.waypoints).at(CYCLES * scenario.cycle_time)
        self.assertGreater(position[0], 0.0)
        self.assertLess(position[0], behind[0] + 1e-3)
        for state in seen:
            self.assertLess(np.abs(velocities_of(state, scenario)[leader]).max(), 0.06, "a leap")


class SeveralOf:
    """True at the message that is the last of so many with a status of this name."""

    def __init__(self, name, count):
        self._name = name
        self._left = count

    def __call__(self, message):
        self._left -= any(status.name == self._name for status in message.status)
        return self._left <= 0


if __name__ == "__main__":
    run_tests("late_pose")
