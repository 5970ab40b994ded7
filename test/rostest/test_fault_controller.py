#!/usr/bin/env python3
"""The node with the controller is killed, and started again."""

from faulty_run import FaultTest
from observed_run import run_tests


class FaultControllerTest(FaultTest):
    def test_killed_and_started_again(self):
        killed = self.kill(self.controller)
        stopped = self.assert_stops(killed)
        self.assert_says("assistant_1 stands still: no command on /assistant_1/cmd_vel")
        self.assertTrue(self.velocity(stopped, self.scenario.leader_index).any())
        self.start(self.controller)
        self.assert_follows()


if __name__ == "__main__":
    run_tests("fault_controller")
