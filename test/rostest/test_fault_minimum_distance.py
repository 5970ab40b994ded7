#!/usr/bin/env python3
"""The node of the distances is killed, and started again."""

from faulty_run import FaultTest
from observed_run import run_tests


class FaultMinimumDistanceTest(FaultTest):
    def test_killed_and_started_again(self):
        stopped = self.assert_stops(self.kill("minimum_distance"))
        self.assert_waits("no distances for")
        self.assert_says("assistant_1: Waits, at rest or slowing down to it: no distances for")
        self.assertTrue(self.velocity(stopped, self.scenario.leader_index).any())
        self.start("minimum_distance")
        self.assert_follows()


if __name__ == "__main__":
    run_tests("fault_minimum_distance")
