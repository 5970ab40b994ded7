#!/usr/bin/env python3
"""rviz_snapshot shows recorded runs: several times in one picture, and as a video."""

import subprocess

import numpy as np
from observed_run import run_tests
from snapshot_command import SCENARIO, SIZE, SnapshotCommandTest, orange_rows

from deformable_manipulation.closed_loop import ClosedLoop
from deformable_manipulation.recording import RunRecorder
from deformable_manipulation.scenario import load_scenario


class RecordedRunTest(SnapshotCommandTest):
    def record(self):
        """The folder of a run of the scenario without ROS."""
        scenario = load_scenario(SCENARIO)
        folder = self.folder / "recorded"
        recorder = RunRecorder(scenario, folder)
        ClosedLoop(scenario).run(recorder)
        recorder.finish(1.0, True)
        return str(folder)

    def test_a_recorded_run_at_several_times_in_one_picture(self):
        options = ["--times", "0,3", "--layout", "overlaid"]
        status, printed, complaints = self.run_command(*options, source=self.record())
        self.assertEqual(status, 0, complaints)
        name = "short_rope_t000_t003_overlaid.png"
        self.assertEqual(printed, [str(self.folder / name)])
        picture = self.read(name)
        status, _, complaints = self.run_command("--times", "3")
        self.assertEqual(status, 0, complaints)
        # The last one is what a live run shows, the first is above it, and paler.
        alive = orange_rows(self.read("short_rope_t003.png"))
        both = orange_rows(picture)
        self.assertLess(abs(both.max() - alive.max()), 2)
        pale = pale_orange_rows(picture)
        self.assertLess(pale.mean(), alive.min() - 10)

    def test_a_video_of_a_recorded_run(self):
        path = self.folder / "run.mp4"
        options = ["--video", str(path), "--speed", "10"]
        status, printed, complaints = self.run_command(*options, source=self.record())
        self.assertEqual((status, printed), (0, [str(path)]), complaints)
        pictures = frames_of(path)
        self.assertEqual(len(pictures), 8 * 25 // 10 + 1)
        heights = [orange_rows(picture).mean() for picture in pictures]
        self.assertGreater(heights[-1], heights[0] + 10)
        self.assertGreater(heights[-1], heights[len(heights) // 2] + 2)


def pale_orange_rows(picture):
    """Rows of pixels half way from the agents' balls to the background."""
    red, green, blue = np.moveaxis(picture.astype(int), 2, 0)
    return np.nonzero((red > 200) & (green > 160) & (green < 225) & (blue > 90) & (blue < 170))[0]


def frames_of(path):
    """The pictures of a video."""
    command = ["ffmpeg", "-loglevel", "error", "-i", str(path), "-f", "rawvideo"]
    command += ["-pix_fmt", "rgb24", "-"]
    data = subprocess.run(command, stdout=subprocess.PIPE, check=True).stdout
    return np.frombuffer(data, np.uint8).reshape(-1, SIZE[1], SIZE[0], 3)


if __name__ == "__main__":
    run_tests("recorded_run")
