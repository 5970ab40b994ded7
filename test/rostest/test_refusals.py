#!/usr/bin/env python3
"""What cannot work leaves with an exit status that is not zero, and says why."""

import os
import socket
import subprocess
import tempfile
import unittest
from pathlib import Path

import rospy
from observed_run import DEADLINE, PACKAGE, run_tests
from roslib.packages import find_node

from deformable_manipulation.scenario import load_scenario, scenario_to_mapping

NODES = ("simulator_node", "minimum_distance_node", "leader_node", "controller_node")
SHORT_ROPE = Path(__file__).resolve().parent / "short_rope.yaml"


def start(command, **environment):
    return subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        universal_newlines=True,
        env={**os.environ, **environment},
    )


def start_node(executable, namespace, *arguments):
    (path,) = find_node(PACKAGE, executable)[:1]
    return start([path, "__ns:=" + namespace, "__name:=" + executable, *arguments])


def correct_scenario():
    return scenario_to_mapping(load_scenario(SHORT_ROPE))


def free_port():
    with socket.socket() as free:
        free.bind(("", 0))
        return free.getsockname()[1]


class RefusalsTest(unittest.TestCase):
    def assert_refuses(self, process, *texts):
        """The process leaves, not with success, and its output has all these texts."""
        try:
            output, _ = process.communicate(timeout=DEADLINE)
        finally:
            process.kill()
            process.wait()
        self.assertGreater(process.returncode, 0, output)
        for text in texts:
            self.assertIn(text, output)
        self.assertNotIn("Traceback", output)
        return output

    def assert_all_refuse(self, namespace, *texts):
        processes = {name: start_node(name, namespace) for name in NODES}
        for name, process in processes.items():
            with self.subTest(node=name):
                self.assert_refuses(process, *texts)

    def test_a_missing_scenario(self):
        self.assert_all_refuse("/empty", "/empty/scenario is missing", "run.launch")

    def test_a_wrong_scenario(self):
        scenario = correct_scenario()
        del scenario["object"]["length"]
        scenario["controller"]["rate"] = "fast"
        rospy.set_param("/wrong/scenario", scenario)
        self.assert_all_refuse("/wrong", "object.length", "controller.rate", "fast")

    def test_a_controller_of_nobody(self):
        rospy.set_param("/right/scenario", correct_scenario())
        for arguments in ([], ["_agent:=leader"]):
            with self.subTest(arguments=arguments):
                self.assert_refuses(
                    start_node("controller_node", "/right", *arguments),
                    "/right/controller_node/agent",
                    "assistant_1",
                )

    def assert_launch_refuses(self, path, *texts):
        """A launch with this scenario file ends before any node starts."""
        port = free_port()
        command = ["roslaunch", "--port", str(port), PACKAGE, "run.launch", "rviz:=false"]
        output = self.assert_refuses(
            start(
                command + ["scenario:={}".format(path)],
                ROS_MASTER_URI="http://localhost:{}".format(port),
            ),
            *texts
        )
        self.assertNotIn("started with pid", output)

    def assert_launch_refuses_changes(self, changes, *texts):
        """So does one with the short rope's file after these changes of its text."""
        text = SHORT_ROPE.read_text()
        for old, new in changes:
            self.assertIn(old, text)
            text = text.replace(old, new)
        with tempfile.TemporaryDirectory() as folder:
            wrong = Path(folder) / "wrong.yaml"
            wrong.write_text(text)
            self.assert_launch_refuses(wrong, *texts)

    def test_a_launch_with_wrong_types_and_ranges(self):
        self.assert_launch_refuses_changes(
            [
                ("offset: 0.05", "offset: -1.0, colour: red"),
                ("radius: 0.0035", "radius: [thin]"),
                ("obstacles/ground.csv", "obstacles/no_such.csv"),
            ],
            "controller.collision.offset",
            "controller.collision.colour",
            "object.radius",
            "obstacles.0.polygon",
            "no_such.csv",
        )

    def test_a_launch_without_its_scenario_file(self):
        self.assert_launch_refuses("/nowhere/missing.yaml", "/nowhere/missing.yaml")

    def test_a_launch_with_a_file_that_is_not_yaml(self):
        self.assert_launch_refuses_changes([("object:", "object: [")], "wrong.yaml")


if __name__ == "__main__":
    run_tests("refusals")
