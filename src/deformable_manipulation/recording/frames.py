"""Where the object and the agents of a recorded run were, now and then."""

import os
import zipfile
from dataclasses import dataclass
from pathlib import Path
from typing import Optional, Tuple

import numpy as np

from deformable_manipulation.obstacle_motion import placed_obstacles
from deformable_manipulation.recording import run_files
from deformable_manipulation.recording.run_data import RunData, RunDataError
from deformable_manipulation.scenario import ScenarioError, load_scenario
from deformable_manipulation.scenario.spec import Scenario
from deformable_manipulation.text_files import open_regular


@dataclass(frozen=True)
class Frames:
    """F frames of a run: A agents, P geometry points of the object itself."""

    scenario: Scenario
    times: np.ndarray  # (F,) s, increasing
    points: np.ndarray  # (F, P, 3) m
    agents: np.ndarray  # (F, A, 3) m, held points, in the scenario's order
    faces: Optional[np.ndarray] = None  # (T, 3) triangles of a fabric; None: a rod's polyline
    obstacles: Optional[np.ndarray] = None  # (F, K, 7) poses of the moving ones; None: not recorded

    def at(self, time: float) -> int:
        """Index of the frame nearest to a time [s]."""
        return int(np.argmin(np.abs(self.times - time)))

    def obstacles_at(self, frame: int) -> tuple:
        """The scenario's obstacles, where they were in a frame."""
        if self.obstacles is None:
            return self.scenario.obstacles
        return placed_obstacles(self.scenario, self.obstacles[frame])

    def between(self, time: float) -> Tuple[np.ndarray, np.ndarray]:
        """Points (P, 3) and held points (A, 3) [m] at a time [s], linear between frames."""
        after = int(np.clip(np.searchsorted(self.times, time), 1, max(len(self.times) - 1, 1)))
        after = min(after, len(self.times) - 1)
        before = max(after - 1, 0)
        span = float(self.times[after] - self.times[before])
        share = min(max((time - float(self.times[before])) / span, 0.0), 1.0) if span else 0.0
        return tuple(
            (1.0 - share) * values[before].astype(float) + share * values[after].astype(float)
            for values in (self.points, self.agents)
        )


def read_frames(run: RunData) -> Frames:
    """The frames of a run that was read by :func:`~.run_data.read_run`.

    Raises RunDataError: there are none, or they cannot be read.
    """
    if run.path.is_dir():
        return _read_folder(run.path)
    # Imported late: needs the bag's library.
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
    return Frames(scenario, times, points, agents, arrays.get("faces"), arrays.get("obstacles"))
