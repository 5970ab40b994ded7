#!/usr/bin/env python3
"""rviz_snapshot takes pictures of a run of its own, or says why not, and leaves nothing behind."""

import os
import shutil
import signal
import subprocess
import tempfile
import unittest
import uuid
from pathlib import Path

import numpy as np
import rosgraph
import yaml
from matplotlib.image import imread
from observed_run import poll, run_tests

from deformable_manipulation.ros.picture import shows_scene
from deformable_manipulation.scenario import package_share_directory

SHARE = package_share_directory()
SCENARIO = str(SHARE / "test" / "rostest" / "short_rope.yaml")
SIZE = (640, 400)
MARK = "RVIZ_SNAPSHOT_TEST"  # in the environment of all its programs

RUN_BESIDE = {"/simulator", "/leader", "/assistants"}


class RvizSnapshotTest(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, str(self.folder))
        self.mark = uuid.uuid4().hex
        poll(lambda: RUN_BESIDE <= self.nodes_here(), "the nodes of the run beside")
        self.nodes = self.nodes_here()
        self.addCleanup(self.assert_nothing_is_left)

    def start(self, *arguments):
        command = ["python3", "-m", "deformable_manipulation.commands.rviz_snapshot", SCENARIO]
        command += ["--output", str(self.folder), "--size", "{}x{}".format(*SIZE), *arguments]
        return subprocess.Popen(
            command,
            env=dict(os.environ, **{MARK: self.mark}),
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            universal_newlines=True,
        )

    def run_command(self, *arguments):
        with self.start(*arguments) as command:
            printed, complaints = command.communicate()
        return command.returncode, printed.split(), complaints

    def read(self, name):
        picture = np.rint(255 * imread(str(self.folder / name))[:, :, :3]).astype(np.uint8)
        self.assertEqual(picture.shape, (SIZE[1], SIZE[0], 3))
        return picture

    @staticmethod
    def nodes_here():
        published, subscribed, services = rosgraph.Master("/test").getSystemState()
        names = published + subscribed + services
        return {node for _, nodes in names for node in nodes}

    def programs(self):
        """Process ids of the command and of all that it started."""
        found = []
        for entry in Path("/proc").iterdir():
            try:
                if entry.name.isdigit() and self.mark.encode() in (entry / "environ").read_bytes():
                    found.append(int(entry.name))
            except (FileNotFoundError, ProcessLookupError, PermissionError):
                continue
        return found

    def assert_nothing_is_left(self):
        poll(lambda: not self.programs(), "the end of all programs")
        self.assertEqual(self.nodes_here(), self.nodes)

    def test_pictures_of_a_run(self):
        status, printed, complaints = self.run_command("--times", "0,3")
        self.assertEqual(status, 0, complaints)
        names = ["short_rope_t000.png", "short_rope_t003.png"]
        self.assertEqual(printed, [str(self.folder / name) for name in names])
        start, later = (self.read(name) for name in names)
        self.assertTrue(shows_scene(start))
        self.assertTrue(shows_scene(later))
        # The agents are lowered: so are their orange balls.
        self.assertGreater(orange_height(later), orange_height(start) + 10)

    def test_the_same_state_gives_the_same_picture_from_every_run(self):
        pictures = []
        for _ in range(2):
            status, _, complaints = self.run_command("--times", "0.5", "--view", "YZ")
            self.assertEqual(status, 0, complaints)
            pictures.append(self.read("short_rope_t000.5.png"))
        # Where two things are in the same depth, a pixel may show the one or the other.
        different = np.any(pictures[0] != pictures[1], axis=2)
        self.assertLess(different.mean(), 2e-4)

    def change_configuration(self, change):
        text = (SHARE / "rviz" / "rope_one_assistant.rviz").read_text()
        configuration = yaml.safe_load(text)
        change(configuration["Visualization Manager"])
        path = self.folder / "changed.rviz"
        path.write_text(yaml.safe_dump(configuration))
        return str(path)

    def assert_nothing_rendered(self, change, reason):
        path = self.change_configuration(change)
        options = ["--times", "0", "--config", path, "--timeout", "15"]
        status, printed, complaints = self.run_command(*options)
        self.assertEqual((status, printed), (1, []), complaints)
        self.assertIn("nothing was rendered: " + reason, complaints)

    def test_a_view_of_nothing(self):
        def look_away(manager):
            manager["Views"]["Current"]["Focal Point"] = {"X": 0, "Y": 500, "Z": 900}

        self.assert_nothing_rendered(look_away, "the 3D view is blank")

    def test_a_configuration_that_does_not_show_the_run(self):
        def hide(manager):
            manager["Displays"] = []

        self.assert_nothing_rendered(hide, "RViz did not receive /markers")

    def test_an_interruption_ends_everything(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.start("--times", "8") as command:
                poll(lambda: len(self.programs()) > 7, "the programs of the run")
                command.send_signal(number)
                printed, complaints = command.communicate()
            self.assertEqual((command.returncode, printed), (128 + number, ""), complaints)
            self.assertNotIn("Traceback", complaints)
            self.assert_nothing_is_left()


def orange_height(picture):
    """The mean row of the agents' balls, from the top."""
    red, green, blue = np.moveaxis(picture.astype(int), 2, 0)
    rows, _ = np.nonzero((red > 180) & (green > 100) & (green < 170) & (blue < 60))
    return rows.mean()


if __name__ == "__main__":
    run_tests("rviz_snapshot")
