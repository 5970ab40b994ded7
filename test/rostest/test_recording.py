#!/usr/bin/env python3
"""A bag of a lock-step run has every message, also where its recorder is slow."""

import collections
import os
import signal
import tempfile
import unittest
from pathlib import Path

import numpy as np
from faulty_run import process_of
from observed_run import PACKAGE, run_tests
from rosbags.rosbag1 import Reader

from deformable_manipulation.ros.private_master import private_master
from deformable_manipulation.system.program import Program

SCENARIO = Path(__file__).resolve().parent / "short_rope.yaml"
CYCLES = 2000  # many more than any queue keeps
BEGUN = 10**6  # bytes of a bag that are some ten cycles
PER_CYCLE = (
    "/state",
    "/distances",
    "/leader/cmd_vel",
    "/assistant_1/cmd_vel",
    "/assistant_1/controller_state",
)
DEADLINE = 60.0  # s


class RecordingTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.log = self.folder / "run.log"

    def start(self):
        """A lock-step run of a scenario with a rate of 100 Hz, recorded; the program."""
        return Program(
            "the run",
            [
                "roslaunch",
                PACKAGE,
                "run.launch",
                "scenario:={}".format(SCENARIO),
                "rviz:=false",
                "lockstep:=true",
                "record:=true",
                "output:={}".format(self.folder),
                "set:=simulation.duration={}".format(CYCLES / 100),
            ],
            self.log,
        )

    def printed(self, text):
        return text in self.log.read_text(errors="replace")

    def begun(self):
        return any(bag.stat().st_size > BEGUN for bag in self.folder.glob("*.bag.active"))

    def bags(self):
        return list(self.folder.glob("*.bag"))

    def stamps(self):
        """Stamps [ns] of the messages of each topic that has them."""
        found = collections.defaultdict(list)
        (path,) = self.bags()
        with Reader(path) as reader:
            for connection, _, data in reader.messages():
                second, nanosecond = (int.from_bytes(data[i : i + 4], "little") for i in (4, 8))
                found[connection.topic].append(second * 10**9 + nanosecond)
        return found

    def test_no_message_is_lost_to_a_recorder_that_stands_still_for_a_while(self):
        with private_master(self.folder), self.start() as run:
            run.wait_until(self.begun, DEADLINE, "no recording")
            recorder = process_of("recorder")
            os.kill(recorder, signal.SIGSTOP)
            try:
                run.wait_until(
                    lambda: self.printed("still waiting for the recorder"), DEADLINE, "no wait"
                )
                self.assertFalse(self.printed("End of the scenario"))
            finally:
                os.kill(recorder, signal.SIGCONT)
            run.wait_until(self.bags, DEADLINE, "no bag")
        stamps = self.stamps()
        expected = stamps["/state"][0] + 10**7 * np.arange(CYCLES)
        for topic in PER_CYCLE:
            np.testing.assert_array_equal(sorted(set(stamps[topic])), expected, topic)


if __name__ == "__main__":
    run_tests("recording")
