"""An MP4 file that ffmpeg makes of pictures."""

import contextlib
import os
import shutil
import subprocess
import tempfile

from deformable_manipulation.system.program import ProgramError

RATE = 25  # pictures per second
_QUALITY = 18  # of x264, constant rate factor: looks almost like the original
_END_TIMEOUT = 60.0  # s


def require_ffmpeg():
    """Raises ProgramError if ffmpeg is not installed."""
    if shutil.which("ffmpeg") is None:
        raise ProgramError("ffmpeg, which makes videos, is not installed: apt-get install ffmpeg")


@contextlib.contextmanager
def video_file(path, size):
    """A video, for the time of a with statement; it is complete when that has ended without error.

    Args:
        path: of the MP4 file; what was there is replaced.
        size: width and height in pixels.

    Yields:
        A function that adds a picture (height, width, 3).

    Raises:
        ProgramError: ffmpeg cannot write it.
    """
    require_ffmpeg()
    temporary = path.with_name(f".{path.name}.{os.getpid()}.part.mp4")
    with tempfile.TemporaryFile() as log, contextlib.ExitStack() as stack:
        stack.callback(lambda: temporary.unlink() if temporary.exists() else None)
        # A session of its own: Ctrl-C reaches the command alone, which then ends its programs.
        ffmpeg = subprocess.Popen(
            ["setpriv", "--pdeathsig", "TERM", *_command(temporary, size)],
            stdin=subprocess.PIPE,
            stdout=log,
            stderr=log,
            start_new_session=True,
        )
        stack.callback(_end, ffmpeg)
        pipe = ffmpeg.stdin
        assert pipe is not None
        try:
            yield lambda picture: pipe.write(picture.tobytes())
            pipe.close()
            status = ffmpeg.wait(_END_TIMEOUT)
        except (BrokenPipeError, subprocess.TimeoutExpired):
            status = None
        if status != 0:
            log.seek(0)
            printed = log.read().decode(errors="replace").strip()
            raise ProgramError(f"ffmpeg cannot write {path}:\n{printed}")
        os.replace(str(temporary), str(path))


def _command(path, size):
    command = ["ffmpeg", "-y", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24"]
    command += ["-video_size", "{}x{}".format(*size), "-framerate", str(RATE), "-i", "-"]
    # Players want even sizes and this kind of colors; the index first, for browsers.
    command += ["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p"]
    command += ["-c:v", "libx264", "-crf", str(_QUALITY), "-movflags", "+faststart", str(path)]
    return command


def _end(process):
    if process.poll() is None:
        process.kill()
        process.wait()
    with contextlib.suppress(OSError):
        process.stdin.close()
