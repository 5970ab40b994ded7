#!/usr/bin/env python3
"""What cannot work leaves with an exit status that is not zero, and says why."""

import os
import signal
import socket
import subprocess
import tempfile
import unittest
from pathlib import Path
from xmlrpc.client import ServerProxy

import rospy
from observed_run import DEADLINE, PACKAGE, poll, run_tests
from roslib.packages import find_node

from deformable_manipulation.scenario import load_scenario, scenario_to_mapping

NODES = (
    "simulator_node",
    "minimum_distance_node",
    "leader_node",
    "controller_node",
    "assistants_node",
)
SHORT_ROPE = Path(__file__).resolve().parent / "short_rope.yaml"
SMALL_FABRIC = SHORT_ROPE.with_name("small_fabric.yaml")


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


def start_launch(*arguments):
    """run.launch on a master of its own: the process, and the master's address."""
    port = free_port()
    master = "http://localhost:{}".format(port)
    command = ["roslaunch", "--port", str(port), PACKAGE, "run.launch", "rviz:=false", *arguments]
    return start(command, ROS_MASTER_URI=master), master


def kill_node(name, master):
    """Kill a node as soon as it is there."""

    def process():
        try:
            uri = ServerProxy(master).lookupNode("/test", name)[2]
            return uri and ServerProxy(uri).getPid("/test")[2]
        except OSError:
            return None  # no master, or no answer yet

    poll(process, name)
    os.kill(process(), signal.SIGKILL)


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

    def test_a_mesh_that_has_gone(self):
        scenario = correct_scenario()
        scenario["obstacles"].append({"name": "cube", "mesh": "/nowhere/cube.obj"})
        rospy.set_param("/gone/scenario", scenario)
        self.assert_refuses(
            start_node("minimum_distance_node", "/gone"), "obstacles cannot be used", "/nowhere"
        )

    def test_a_wrong_fabric(self):
        scenario = scenario_to_mapping(load_scenario(SMALL_FABRIC))
        scenario["object"]["mesh"]["vertices"][12] = [0.0, 0.0]
        scenario["object"]["thickness"] = "thin"
        rospy.set_param("/fabric/scenario", scenario)
        self.assert_all_refuse("/fabric", "object.mesh.vertices.12", "object.thickness")

    def test_a_controller_of_nobody(self):
        rospy.set_param("/right/scenario", correct_scenario())
        for node, parameter in (("controller_node", "agent"), ("assistants_node", "agents")):
            for arguments in ([], ["_{}:=leader".format(parameter)]):
                with self.subTest(node=node, arguments=arguments):
                    self.assert_refuses(
                        start_node(node, "/right", *arguments),
                        "/right/{}/{}".format(node, parameter),
                        "assistant_1",
                    )

    def assert_launch_refuses(self, path, *texts, arguments=()):
        """A launch with this scenario file and arguments ends before any node starts."""
        launch, _ = start_launch("scenario:={}".format(path), *arguments)
        output = self.assert_refuses(launch, *texts)
        for text in texts:
            self.assertGreater(output.rindex(text), output.rindex("RLException"), output)
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

    def test_a_launch_whose_arguments_do_not_fit_the_scenario(self):
        self.assert_launch_refuses(
            SHORT_ROPE,
            "'assistant_7'",
            "did you mean 'assistant_1'?",
            "'boss'",
            "leader:=leader",
            "'/nowhere/bags' \u2014 does not exist",
            arguments=[
                "assistants:=assistant_7",
                "lockstep:=true",
                "leader:=boss",
                "record:=true",
                "output:=/nowhere/bags",
            ],
        )

    def test_a_launch_in_a_namespace_that_cannot_be(self):
        self.assert_launch_refuses(
            SHORT_ROPE, "namespace: 'left-hand'", arguments=["namespace:=left-hand"]
        )

    def test_a_lock_step_launch_without_one_of_its_assistants(self):
        two_assistants = SHORT_ROPE.with_name("two_assistants.yaml")
        self.assert_launch_refuses(
            two_assistants,
            'use assistants:="middle_assistant end_assistant"',
            arguments=["assistants:=end_assistant", "lockstep:=true"],
        )

    def test_a_lock_step_run_ends_when_a_node_has_gone(self):
        for name, one_process in (
            ("assistants", "true"),
            ("leader", "true"),
            ("assistant_1_controller", "false"),
            ("minimum_distance", "false"),
        ):
            launch, master = start_launch(
                "scenario:={}".format(SHORT_ROPE),
                "lockstep:=true",
                "stop_at_end:=false",
                "one_process:=" + one_process,
            )
            with self.subTest(node=name), launch:
                kill_node("/" + name, master)
                output, _ = launch.communicate(timeout=DEADLINE)
                self.assertIn("REQUIRED process [{}-".format(name), output)

    def test_names_and_values_with_blanks_are_no_mistake(self):
        with tempfile.TemporaryDirectory(prefix="two words ") as folder:
            path = Path(folder) / "a rope.yaml"
            path.write_text(SHORT_ROPE.read_text())
            launch, _ = start_launch(
                "scenario:={}".format(path),
                'set:=agents.assistant_1.start=[0.0, 1.4, 1.35] name="a b" simulation.duration=1',
                "lockstep:=true",
                "record:=true",
                "output:={}".format(folder),
            )
            with launch:
                output, _ = launch.communicate(timeout=DEADLINE)
            self.assertIn("End of the scenario after 1.00 s", output)
            bags = list(Path(folder).glob("a rope_*.bag"))
            self.assertEqual(len(bags), 1, output)

    def test_a_launch_with_a_file_that_is_not_yaml(self):
        self.assert_launch_refuses_changes([("object:", "object: [")], "wrong.yaml")


if __name__ == "__main__":
    run_tests("refusals")
