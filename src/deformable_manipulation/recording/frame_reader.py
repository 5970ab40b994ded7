"""Reads the frames of a run from its folder or bag."""

import os
import zipfile
from pathlib import Path

import numpy as np

from deformable_manipulation.recording import run_files
from deformable_manipulation.recording.frames import Frames
from deformable_manipulation.recording.run_data import RunData, RunDataError
from deformable_manipulation.scenario import ScenarioError, load_scenario
from deformable_manipulation.system.text_files import open_regular


def read_frames(run: RunData) -> Frames:
    """The frames of a run that was read by :func:`~.run_reader.read_run`.

    Raises:
        RunDataError: there are none, or they cannot be read.
    """
    if run.path.is_dir():
        return _read_folder(run.path)
    # Imported late: the library of bags is slow to load.
    from deformable_manipulation.recording.bag_frames import read_bag_frames

    return read_bag_frames(run.path, run.namespace)


def _read_folder(folder: Path) -> Frames:
    path = folder / run_files.STATES
    if not os.path.exists(str(path)):
        raise RunDataError(f"{folder} contains no {run_files.STATES}: there are no shapes to draw")
    try:
        with open_regular(path) as file, np.load(file) as states:
            arrays = {name: states[name] for name in states.files}
        times, points, agents = (arrays[name] for name in ("times", "points", "agents"))
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile) as error:
        raise RunDataError(f"{path} cannot be read: {error}") from error
    if not len(times):
        raise RunDataError(f"{path} contains no frame")
    try:
        scenario = load_scenario(folder / run_files.SCENARIO)
    except ScenarioError as error:
        raise RunDataError(str(error)) from error
    return Frames(scenario, times, points, agents, arrays.get("obstacles"))
