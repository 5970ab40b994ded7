"""Reads a run from its folder or from a bag."""

import os
from pathlib import Path
from typing import List, Optional

from deformable_manipulation.recording import run_files
from deformable_manipulation.recording.folder_reader import read_folder
from deformable_manipulation.recording.run_data import RunData, RunDataError

BAG_SUFFIXES = (".bag", ".bag.active")


def read_run(path, namespace: Optional[str] = None) -> RunData:
    """Read a run folder, a bag, or a folder that holds exactly one bag.

    ``namespace`` chooses one of several runs that were recorded side by side into one bag.

    Raises:
        RunDataError: there is no run, or it cannot be read.
    """
    path = Path(path)
    if not os.path.exists(str(path)):  # unlike Path.exists also for names too long for any file
        raise RunDataError(f"{path} does not exist")
    if (path / run_files.TIMESERIES).is_file():
        return read_folder(path)
    bag = _only_bag(path) if path.is_dir() else path
    if not bag.name.endswith(BAG_SUFFIXES):
        raise RunDataError(
            f"{path} is neither a run folder nor a bag; give the folder that run_scenario wrote, "
            "or a file recorded by rosbag"
        )
    # Imported late: the library of bags is slow to load.
    from deformable_manipulation.recording.bag_reader import read_bag

    return read_bag(bag, namespace)


def holds_run(folder: Path) -> bool:
    """Whether a folder has what read_run reads in it, or several of it."""
    return (folder / run_files.TIMESERIES).exists() or bool(_bags(folder))


def _bags(folder: Path) -> List[Path]:
    return sorted(path for path in folder.iterdir() if path.name.endswith(BAG_SUFFIXES))


def _only_bag(folder: Path) -> Path:
    bags = _bags(folder)
    if not bags:
        raise RunDataError(f"{folder} holds neither {run_files.TIMESERIES} nor a bag")
    if len(bags) > 1:
        raise RunDataError(
            "{} holds several bags; give one of them: {}".format(
                folder, ", ".join(path.name for path in bags)
            )
        )
    return bags[0]
