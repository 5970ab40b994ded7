#!/usr/bin/env python3
"""The ROS clock leaps back and forward, and stands still, while real time goes on."""

import threading
import time

import numpy as np
import rospy
from faulty_run import FaultTest
from observed_run import run_tests
from rosgraph_msgs.msg import Clock

PERIOD = 0.002  # s
START = 1000.0  # s
LEAP = 100.0  # s
CYCLES = 50


class ClockDriver:
    """Publishes the time as it goes by, plus an offset that can be changed.

    Attributes:
        offset: s.
        stands: keeps time as it is.
    """

    def __init__(self):
        self.offset = START
        self.stands = False
        self._began = time.monotonic()
        self._publisher = rospy.Publisher("/clock", Clock, queue_size=1)
        self._stopped = threading.Event()
        rospy.on_shutdown(self._stopped.set)
        threading.Thread(target=self._run, daemon=True).start()

    def _run(self):
        while not self._stopped.wait(PERIOD):
            if not self.stands:
                now = time.monotonic() - self._began + self.offset
                self._publisher.publish(Clock(rospy.Time.from_sec(now)))


class FaultClockTest(FaultTest):
    @classmethod
    def setUpClass(cls):
        cls.clock = ClockDriver()
        super().setUpClass()

    def leap(self, offset):
        """Set the clock by so much [s]; the states from the last one before on."""
        start = len(self.states) - 1
        self.clock.offset += offset
        after = self.states.wait_for(
            lambda state: (
                abs((state.header.stamp - self.states[start].header.stamp).to_sec()) > 0.5 * LEAP
            ),
            "a state after the leap",
            start,
        )
        self.assert_follows()
        self.states.wait_for(
            lambda state: state.cycle > after.cycle + CYCLES, "further states", start
        )
        return self.states[start:]

    def assert_moves_calmly(self, states):
        """The assistant stands, or follows at about the speed of its leader: no leap."""
        leader = self.scenario.leader_index
        limit = 2.0 * max(abs(self.velocity(state, leader)).max() for state in states)
        self.assertLess(max(abs(self.velocity(state)).max() for state in states), limit)
        cycles = [state.cycle for state in states]
        self.assertEqual(cycles, list(range(cycles[0], cycles[0] + len(cycles))))
        moving = [self.velocity(state).any() for state in states]
        patience = self.scenario.controller.timeout / self.scenario.cycle_time
        self.assertLess(moving.count(False), patience + CYCLES)

    def test_back(self):
        self.assert_moves_calmly(self.leap(-LEAP))
        self.assert_says("The clock was set back by")

    def test_forward(self):
        self.assert_moves_calmly(self.leap(LEAP))

    def test_it_stands_still(self):
        self.clock.stands = True
        self.addCleanup(setattr, self.clock, "stands", False)
        start = len(self.states)
        self.assert_says("assistant_1 ignores a command", "not newer")
        self.assert_says("assistant_1 stands still: no command on /assistant_1/cmd_vel")
        moving = self.moving_cycles(start)
        rospy.loginfo("%s: moved for %d cycles", self.id(), moving)
        self.assertLess(moving * self.scenario.cycle_time, self.patience())
        self.clock.stands = False
        self.assert_follows()

    def moving_cycles(self, start):
        """Number of states from ``start`` on until the assistant stands for good."""
        self.states.wait_for(lambda state: not self.velocity(state).any(), "a stop", start)
        further = self.states.wait_for_more(CYCLES)
        self.assertFalse(any(self.velocity(state).any() for state in further))
        return int(np.count_nonzero([self.velocity(state).any() for state in self.states[start:]]))


if __name__ == "__main__":
    run_tests("fault_clock")
