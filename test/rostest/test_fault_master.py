#!/usr/bin/env python3
"""The ROS master goes: the run goes on, and stays safe.

It has a master of its own, so that the test's result still finds its way.
"""

import os
import signal
import tempfile
from pathlib import Path

import rosgraph
import rospy
from faulty_run import FaultTest
from observed_run import PACKAGE, poll, run_tests

from deformable_manipulation.ros.private_master import private_master
from deformable_manipulation.system.program import Program

LAUNCH = Path(__file__).resolve().parent / "fault_run.launch"
CYCLES = 100


class FaultMasterTest(FaultTest):
    @classmethod
    def setUpClass(cls):
        poll(lambda: rospy.has_param("scenario"), "the launch")
        super().setUpClass()

    def assert_no_other_node_is_gone(self):
        for process in self.processes.values():
            os.kill(process, 0)  # there is no master to ask

    def test_the_run_goes_on(self):
        MASTER.stop()
        poll(lambda: not rosgraph.is_master_online(), "the end of the master")
        self.assert_goes_on(CYCLES)
        self.assert_follows()
        # A fault that comes on top still ends in a stop.
        since = rospy.Time.now()
        os.kill(self.processes.pop(self.controller), signal.SIGKILL)
        self.assert_stops(since)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder, private_master(folder) as MASTER:
        command = ["roslaunch", "--wait", str(LAUNCH)]
        with Program("roslaunch " + PACKAGE, command, Path(folder) / "roslaunch.log"):
            run_tests("fault_master")
