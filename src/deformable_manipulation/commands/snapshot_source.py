"""What pictures are taken of: a scenario, which is run for them, or a recorded run."""

import dataclasses
import os
from dataclasses import dataclass
from pathlib import Path
from typing import List, Optional, Sequence, Tuple

import numpy as np

from deformable_manipulation.recording import RunData, RunDataError, read_run
from deformable_manipulation.recording.frame_reader import read_frames
from deformable_manipulation.recording.frames import Frames
from deformable_manipulation.recording.recorded_motion import with_recorded_motion
from deformable_manipulation.recording.run_reader import BAG_SUFFIXES, holds_run
from deformable_manipulation.scenario import ScenarioError, load_scenario
from deformable_manipulation.scenario.files import find_scenario
from deformable_manipulation.scenario.spec import Scenario

_EVEN = (0.0, 0.25, 0.5, 0.75)  # of the duration


@dataclass(frozen=True)
class SnapshotSource:
    """A scenario and, where it has been run already, the recording of that."""

    scenario: Scenario
    run: Optional[RunData] = None
    frames: Optional[Frames] = None
    file: Optional[Path] = None  # of the scenario, where it was read from one

    @property
    def time_range(self) -> Tuple[float, float]:
        """The first and the last time [s] that can be shown."""
        if self.run is None:
            return 0.0, self.scenario.simulation.duration
        return self.run.time_range

    @property
    def middle(self) -> List[float]:
        """The time [s] in the middle."""
        return [0.5 * sum(self.time_range)]

    def telling_times(self) -> List[float]:
        """Times [s] that show what the run is about.

        Of a scenario, whose run is not known yet, even ones.
        """
        if self.run is None:
            return [share * self.scenario.simulation.duration for share in _EVEN]
        # Imported late: plots.
        from deformable_manipulation.plots.overview_plot import snapshot_times

        return np.clip(snapshot_times(self.run), *self.time_range).tolist()

    @property
    def hides_itself(self) -> bool:
        """Whether pictures of several times over each other would show little."""
        moves = any(obstacle.motion for obstacle in self.scenario.obstacles)
        return moves or self.scenario.object.is_surface

    def bounds(self) -> np.ndarray:
        """The corners (2, 3) [m] of what there is to be seen."""
        # Imported late: geometry of the obstacles.
        from deformable_manipulation.pictures.scene_view import planned_bounds, scene_bounds

        if self.frames is None:
            return planned_bounds(self.scenario)
        return scene_bounds(self.scenario, self.frames.points, self.frames.agents)

    def open(self, directory):
        """The context manager of the run that is shown; ``directory`` is for its files."""
        # Imported late: ROS.
        from deformable_manipulation.ros.played_run import played_run
        from deformable_manipulation.ros.stepped_run import stepped_run

        if self.frames is None:
            return stepped_run(self.scenario, directory)
        return played_run(self.run, self.frames, directory)


def read_source(
    path: str, overrides: Sequence[Tuple[str, str]], namespace: Optional[str]
) -> SnapshotSource:
    """The scenario or run of a name or path.

    Raises:
        ScenarioError, RunDataError: it cannot be read, or cannot have such options.
    """
    if not _is_run(path):
        if namespace is not None:
            raise RunDataError("--namespace is only for bags")
        file = find_scenario(path).resolve()
        return SnapshotSource(load_scenario(path, overrides), file=file)
    if overrides:
        raise RunDataError(f"--set cannot change {path}, which is a recorded run")
    run = read_run(path, namespace)
    frames = read_frames(run)
    scenario = with_recorded_motion(frames)
    return SnapshotSource(scenario, run, dataclasses.replace(frames, scenario=scenario))


def _is_run(path: str) -> bool:
    """Bags and folders, but not an empty folder called like a scenario of this package."""
    if path.endswith(BAG_SUFFIXES):
        return True
    if not os.path.isdir(path):
        return False
    if holds_run(Path(path)):
        return True
    try:
        find_scenario(path)
    except ScenarioError:
        return True
    return False
