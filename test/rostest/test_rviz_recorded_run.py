#!/usr/bin/env python3
"""rviz_snapshot shows recorded runs: several times in one picture, and as a video."""

import subprocess

import numpy as np
from observed_run import run_tests
from snapshot_command import SCENARIO, SHARE, SIZE, SnapshotCommandTest, is_orange, orange_height

from deformable_manipulation.recording import RunRecorder
from deformable_manipulation.running.closed_loop import ClosedLoop
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
        view = ["--times", "0,3", "--config", str(SHARE / "rviz" / "rope_one_assistant.rviz")]
        status, _, complaints = self.run_command(*view)
        self.assertEqual(status, 0, complaints)
        alive = [self.read(f"short_rope_t00{time}.png") for time in (0, 3)]
        source = self.record()
        status, printed, complaints = self.run_command(*view, "--layout=overlaid", source=source)
        self.assertEqual(status, 0, complaints)
        name = "short_rope_t000_t003_overlaid.png"
        self.assertEqual(printed, [str(self.folder / name)])
        picture = self.read(name)
        # The leader is where it is in the pictures of each time, in the color of that time.
        start, later = (picture[is_orange(each)].mean(axis=0) for each in alive)
        self.assertGreater(start[2], start[0] + 60)  # blue
        self.assertGreater(later[0], later[2] + 60)  # vermillion

    def test_a_video_of_a_recorded_run(self):
        path = self.folder / "run.mp4"
        options = ["--video", str(path), "--speed", "10"]
        status, printed, complaints = self.run_command(*options, source=self.record())
        self.assertEqual((status, printed), (0, [str(path)]), complaints)
        pictures = frames_of(path)
        self.assertEqual(len(pictures), 8 * 25 // 10 + 1)
        heights = [orange_height(picture) for picture in pictures]
        self.assertGreater(heights[-1], heights[0] + 10)
        self.assertGreater(heights[-1], heights[len(heights) // 2] + 2)


def frames_of(path):
    """The pictures of a video."""
    command = ["ffmpeg", "-loglevel", "error", "-i", str(path), "-f", "rawvideo"]
    command += ["-pix_fmt", "rgb24", "-"]
    data = subprocess.run(command, stdout=subprocess.PIPE, check=True).stdout
    return np.frombuffer(data, np.uint8).reshape(-1, SIZE[1], SIZE[0], 3)


if __name__ == "__main__":
    run_tests("recorded_run")
