#!/usr/bin/env python3
"""The leader's node is killed, and started again."""

import numpy as np
from faulty_run import AGENT, FaultTest
from observed_run import run_tests

_AT_REST = 1e-4  # m/s


class FaultLeaderTest(FaultTest):
    def test_killed_and_started_again(self):
        self.kill("leader")
        self.assert_says("leader stands still: no command on /leader/cmd_vel")
        # The assistant is sound: it comes to rest at its place beside a leader that stands.
        self.states.wait_for(
            lambda state: abs(self.velocity(state)).max() < _AT_REST,
            "an assistant that rests behind its leader",
            len(self.states),
        )
        self.assert_goes_on()
        self.start("leader")
        moving = self.assert_follows()
        leader = self.velocity(moving, self.scenario.leader_index)
        limit = 1.9 * self.scenario.controller.max_velocity * np.sqrt(3.0)
        self.assertLess(np.linalg.norm(leader), limit, "a leap of the leader behind " + AGENT)


if __name__ == "__main__":
    run_tests("fault_leader")
