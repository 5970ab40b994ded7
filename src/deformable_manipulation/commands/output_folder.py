"""Where a command writes: known to be writable before the work, not after it."""

import os
from pathlib import Path


def writable_folder(folder: Path) -> Path:
    """Make a folder where there is none; returns it.

    Raises:
        OSError: it is no folder, or files cannot be made in it.
    """
    folder.mkdir(parents=True, exist_ok=True)
    probe = folder / f".probe.{os.getpid()}"
    probe.touch()
    probe.unlink()
    return folder
