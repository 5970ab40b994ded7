"""Opens a bag, also one whose recorder was killed before it wrote the index."""

import contextlib
import shutil
import struct
import subprocess
import tempfile
from pathlib import Path
from typing import Iterator, Tuple

from rosbags.rosbag1 import Reader, ReaderError
from rosbags.serde import SerdeError
from rosbags.typesys import TypesysError

from deformable_manipulation.recording.run_data import RunDataError
from deformable_manipulation.system.text_files import TextFileError, read_start

MAGIC = b"#ROSBAG V2.0\n"
RECOVERED = "the recorder had not finished this bag; read from a repaired copy"
# What rosbags raises on bytes that it does not expect.
DAMAGED = (
    (ReaderError, AssertionError, IndexError, KeyError, ValueError, EOFError)
    + (OSError, RuntimeError, struct.error)  # of the decompressors, of numbers cut off
    + (SerdeError, TypesysError, SyntaxError, TypeError)  # of messages and their definitions
)


@contextlib.contextmanager
def open_bag(path: Path) -> Iterator[Tuple[Reader, Tuple[str, ...]]]:
    """Open a bag; yields the reader and notes on how it was opened.

    A bag without a readable index is reindexed in a temporary copy, the bag itself stays as it
    is.

    Raises:
        RunDataError: no bag, or one that cannot be opened or reindexed.
    """
    _check_magic(path)
    with contextlib.ExitStack() as stack:
        try:
            reader = stack.enter_context(Reader(path))
            notes: Tuple[str, ...] = ()
        except DAMAGED as error:
            folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
            copy = _reindexed_copy(path, folder, error)
            reader = _enter_copy(stack, path, copy)
            notes = (RECOVERED,)
        yield reader, notes


def _check_magic(path: Path) -> None:
    try:
        start = read_start(path, len(MAGIC))
    except TextFileError as error:
        raise RunDataError(f"{path} {error}") from error
    if not start:
        raise RunDataError(f"{path} is empty: nothing was recorded")
    if start != MAGIC:
        raise RunDataError(
            f"{path} is not a bag of ROS 1: it does not begin with {MAGIC.decode().strip()}"
        )


def _reindexed_copy(path: Path, folder: Path, reason: Exception) -> Path:
    tool = shutil.which("rosbag")
    if tool is None:
        raise RunDataError(
            f"{path} has no readable index ({reason}), as after a recorder was killed. Run 'rosbag "
            "reindex' on it where ROS is installed; rosbag is not on PATH here"
        )
    copy = folder / "run.bag"
    shutil.copyfile(str(path), str(copy))
    result = subprocess.run(
        [tool, "reindex", "--quiet", str(copy)],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    if result.returncode != 0:
        raise RunDataError(
            f"{path} is damaged ({reason}), and 'rosbag reindex' cannot repair it: "
            f"{result.stdout.strip()}"
        )
    return copy


def _enter_copy(stack: contextlib.ExitStack, path: Path, copy: Path) -> Reader:
    try:
        return stack.enter_context(Reader(copy))
    except DAMAGED as error:
        raise RunDataError(f"{path} is too damaged for 'rosbag reindex': {error}") from error
