#!/usr/bin/env python3
"""rviz_snapshot takes pictures of a run of its own, or says why not, and leaves nothing behind."""

import signal

import numpy as np
import yaml
from observed_run import poll, run_tests
from snapshot_command import SHARE, SnapshotCommandTest, orange_height

from deformable_manipulation.pictures.picture import shows_scene

RUN_BESIDE = {"/simulator", "/leader", "/assistants"}


class RvizSnapshotTest(SnapshotCommandTest):
    def setUp(self):
        poll(lambda: RUN_BESIDE <= self.nodes_here(), "the nodes of the run beside")
        super().setUp()

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

    def assert_nothing_rendered(self, change, reason, timeout):
        path = self.change_configuration(change)
        options = ["--times", "0", "--config", path, "--timeout", timeout]
        status, printed, complaints = self.run_command(*options)
        self.assertEqual((status, printed), (1, []), complaints)
        self.assertIn("nothing was rendered: " + reason, complaints)

    def test_a_view_of_nothing(self):
        def look_away(manager):
            manager["Views"]["Current"]["Focal Point"] = {"X": 0, "Y": 500, "Z": 900}

        # Long enough for RViz to start and to receive the markers.
        self.assert_nothing_rendered(look_away, "the 3D view is blank", "15")

    def test_a_configuration_that_does_not_show_the_run(self):
        def hide(manager):
            manager["Displays"] = []

        self.assert_nothing_rendered(hide, "RViz did not receive /markers", "2")

    def test_an_interruption_ends_everything(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.start("--times", "8") as command:
                poll(lambda: len(self.programs()) > 7, "the programs of the run")
                command.send_signal(number)
                printed, complaints = command.communicate()
            self.assertEqual((command.returncode, printed), (128 + number, ""), complaints)
            self.assertNotIn("Traceback", complaints)
            self.assert_nothing_is_left()


if __name__ == "__main__":
    run_tests("rviz_snapshot")
