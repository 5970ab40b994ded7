"""Videos that are whole, or not there."""

import json
import shutil
import subprocess

import numpy as np
import pytest

from deformable_manipulation.pictures.video_file import RATE, video_file
from deformable_manipulation.system.program import ProgramError

needs_ffmpeg = pytest.mark.skipif(shutil.which("ffprobe") is None, reason="needs ffmpeg")


def probe(path):
    command = ["ffprobe", "-v", "error", "-count_frames", "-of", "json", "-show_streams", str(path)]
    return json.loads(subprocess.run(command, stdout=subprocess.PIPE, check=True).stdout)


@needs_ffmpeg
def test_a_video_of_an_odd_size(tmp_path):
    path = tmp_path / "a.mp4"
    with video_file(path, (65, 41)) as add:
        for shade in range(12):
            add(np.full((41, 65, 3), 20 * shade, dtype=np.uint8))
        assert not path.exists()
    (stream,) = probe(path)["streams"]
    assert (stream["codec_name"], stream["width"], stream["height"]) == ("h264", 66, 42)
    assert (stream["nb_read_frames"], stream["r_frame_rate"]) == ("12", f"{RATE}/1")
    assert list(tmp_path.iterdir()) == [path]


@needs_ffmpeg
def test_an_interruption_leaves_nothing(tmp_path):
    with pytest.raises(KeyboardInterrupt), video_file(tmp_path / "a.mp4", (64, 40)) as add:
        add(np.zeros((40, 64, 3), dtype=np.uint8))
        raise KeyboardInterrupt
    assert list(tmp_path.iterdir()) == []


@needs_ffmpeg
def test_what_ffmpeg_complains_about_is_told(tmp_path):
    with pytest.raises(ProgramError, match="ffmpeg cannot write"):
        with video_file(tmp_path / "absent" / "a.mp4", (64, 40)) as add:
            for _ in range(2000):  # more than a pipe holds
                add(np.zeros((40, 64, 3), dtype=np.uint8))


def test_without_ffmpeg(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(ProgramError, match="ffmpeg.*not installed: apt-get install ffmpeg"):
        with video_file(tmp_path / "a.mp4", (64, 40)):
            pass
