#!/usr/bin/env python3
"""docs/tutorial.md: what needs ROS is done; the rest is done by test_tutorial.py of pytest."""

import importlib
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import rostest

from deformable_manipulation.ros.private_master import private_master
from deformable_manipulation.scenario import package_share_directory

TEST = package_share_directory() / "test"
sys.path.append(str(TEST / "python" / "authoring"))

from tutorial import follow  # noqa: E402  found by the line above

NEEDED = ("new_scenario", "rviz_snapshot")
EARLY = ["--times", "1", "--size", "320x200"]  # go before the page's, which come first
SHORT = ["rviz:=false", "lockstep:=true", "set:=simulation.duration=1"]


class TutorialTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        self.folder = Path(folder.name)
        self.launched = []

    def run_command(self, command, arguments, folder):
        os.chdir(str(folder))
        if command == "rviz_snapshot":
            program = ["python3", "-m", "deformable_manipulation.commands", command]
            self.check([*program, *arguments, *EARLY])
            self.assertTrue(list(folder.glob("*.png")))
        elif command in NEEDED:
            module = importlib.import_module("deformable_manipulation.commands." + command)
            self.assertEqual(module.main(arguments), 0)

    def launch(self, arguments, folder):
        os.chdir(str(folder))
        self.launched.append(arguments[0])
        if any(argument.startswith("set:=") for argument in arguments):
            # Waits for a real arm; its nodes and parameters are checked.
            self.check(["roslaunch", "--dump-params", *arguments])
        else:
            with private_master(folder):
                self.check(["roslaunch", *arguments, *SHORT])

    def check(self, command):
        done = subprocess.run(
            command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True
        )
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertNotIn("[FATAL]", done.stdout)

    def test_every_command_succeeds(self):
        page = package_share_directory() / "docs" / "tutorial.md"
        follow(page, self.folder, self.run_command, self.launch)
        self.assertEqual(
            self.launched,
            ["my_rope.launch", "my_view.launch", "my_team.launch", "my_team.launch"],
        )


if __name__ == "__main__":
    rostest.rosrun("deformable_manipulation", "tutorial", TutorialTest)
