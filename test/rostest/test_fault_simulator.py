#!/usr/bin/env python3
"""The simulator, or the world that it stands for, is killed and started again."""

from faulty_run import AGENT, FaultTest
from geometry_msgs.msg import TwistStamped
from observed_run import Messages, run_tests


class FaultSimulatorTest(FaultTest):
    def test_killed_and_started_again(self):
        commands = Messages(AGENT + "/cmd_vel", TwistStamped)
        killed = self.kill("simulator")
        lost = ["no state for"] if self.one_process else ["no state for", "no distances for"]
        self.assert_waits(*lost)
        self.assert_says("assistant_1: Waits, at rest or slowing down to it: no state for")
        line = self.log.wait_for(lambda line: "no state for" in line.msg, "the reason")
        self.assertLess((line.header.stamp - killed).to_sec(), self.patience())
        for command in commands.wait_for_more(3):
            linear = command.twist.linear
            self.assertEqual([linear.x, linear.y, linear.z], [0.0, 0.0, 0.0])
        self.start("simulator")
        first = self.states.wait_for(
            lambda state: state.header.stamp > line.header.stamp, "a state of the new simulator"
        )
        self.assertLess(first.cycle * self.scenario.cycle_time, 1.0)
        self.assert_follows()


if __name__ == "__main__":
    run_tests("fault_simulator")
