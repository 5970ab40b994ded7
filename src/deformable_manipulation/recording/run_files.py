"""The files of a run: their names, and writing them so that none is ever half written."""

import contextlib
import os
from pathlib import Path
from typing import IO, Iterator

SUMMARY = "summary.json"
TIMESERIES = "timeseries.csv"
STATES = "states.npz"
SCENARIO = "scenario.yaml"
ALL = (SUMMARY, TIMESERIES, STATES, SCENARIO)


class RecordingError(Exception):
    """A run cannot be recorded where it was to be; the message says why and what to do."""


def prepare_folder(directory: Path, overwrite: bool) -> None:
    """Make the folder of a new run.

    The files of an earlier run are removed when ``overwrite`` is set: a later interruption must
    not leave files of two runs side by side.

    Raises:
        RecordingError: the folder holds a run already, or cannot be made or changed.
    """
    try:
        present = [directory / name for name in ALL if (directory / name).exists()]
        if present and not overwrite:
            raise RecordingError(
                "{} already contains a run ({}); choose another folder, or overwrite it with "
                "--force".format(directory, ", ".join(path.name for path in present))
            )
        directory.mkdir(parents=True, exist_ok=True)
        for path in present:
            path.unlink()
    except OSError as error:
        raise RecordingError(
            f"cannot record into {directory}: {error.strerror}; choose a writable folder"
        ) from error


@contextlib.contextmanager
def atomic_file(path: Path, binary: bool = False) -> Iterator[IO]:
    """Open a file that appears under its name only once it is complete.

    It is written under a temporary name in the same folder and renamed at the end; after an
    exception the temporary file is gone and an older file of that name untouched.
    """
    temporary = path.with_name(f".{path.name}.{os.getpid()}.part")
    encoding = None if binary else "utf-8"
    try:
        with open(str(temporary), "wb" if binary else "w", encoding=encoding) as file:
            yield file
        os.replace(str(temporary), str(path))
    except BaseException:
        with contextlib.suppress(FileNotFoundError):
            temporary.unlink()
        raise
