"""The command rviz_snapshot as its tests run it, and what they see in its pictures."""

import os
import shutil
import subprocess
import tempfile
import unittest
import uuid
from pathlib import Path

import numpy as np
import rosgraph
from matplotlib.image import imread
from observed_run import poll

from deformable_manipulation.scenario import package_share_directory

SHARE = package_share_directory()
SCENARIO = str(SHARE / "test" / "rostest" / "short_rope.yaml")
SIZE = (640, 400)
MARK = "RVIZ_SNAPSHOT_TEST"  # in the environment of all its programs


class SnapshotCommandTest(unittest.TestCase):
    """Runs the command, in a folder of its own, and sees that nothing of it is left."""

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, str(self.folder))
        self.mark = uuid.uuid4().hex
        self.nodes = self.nodes_here()
        self.addCleanup(self.assert_nothing_is_left)

    def start(self, *arguments, source=SCENARIO):
        command = ["python3", "-m", "deformable_manipulation.commands", "rviz_snapshot", source]
        command += ["--output", str(self.folder), "--size", "{}x{}".format(*SIZE), *arguments]
        return subprocess.Popen(
            command,
            env=dict(os.environ, **{MARK: self.mark}),
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            universal_newlines=True,
        )

    def run_command(self, *arguments, **options):
        with self.start(*arguments, **options) as command:
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


def orange_height(picture):
    """The mean row of the agents' balls, from the top."""
    return np.nonzero(is_orange(picture))[0].mean()


def is_orange(picture):
    """Which pixels (height, width) are of the agents' balls."""
    red, green, blue = np.moveaxis(picture.astype(int), 2, 0)
    return (red > 180) & (green > 100) & (green < 170) & (blue < 60)
