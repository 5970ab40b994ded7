"""How far the object with given parameters is from its recordings."""

from dataclasses import dataclass
from functools import partial
from typing import Callable, Dict, List, Sequence

import numpy as np

from deformable_manipulation._pbd import NonFiniteState
from deformable_manipulation.identification.material_parameters import MaterialParameters
from deformable_manipulation.replaying.difference import difference
from deformable_manipulation.replaying.measured_shapes import MeasuredShapes, MeasuredShapesError
from deformable_manipulation.replaying.replay import Replay, ReplayOptions

_SAMPLES = 0.05  # s between the shapes that are compared: neighbours tell the same
_LOST = 1.0  # m, where the simulation ended


@dataclass(frozen=True)
class Window:
    """A piece of a recording that is replayed from its first shape.

    Attributes:
        recording: its number.
        replay: ready to be run.
    """

    recording: int
    replay: Replay

    def residuals(self, parameters: MaterialParameters, vector: np.ndarray) -> np.ndarray:
        """Deviations (R,) [m] of seen points that no grip holds, at some of the times."""
        shapes = self.replay.shapes
        try:
            predicted = self.replay.run(parameters.object_of(vector), parameters.aim_of(vector))
        except NonFiniteState:
            predicted = shapes.points + _LOST
        error = (predicted - shapes.points)[self._frames()][:, self._free_points()]
        return error[np.isfinite(error)]

    def errors(self, parameters: MaterialParameters, vector: np.ndarray) -> Dict[str, float]:
        """Numbers of :class:`.Difference`."""
        spec, aim = parameters.object_of(vector), parameters.aim_of(vector)
        try:
            return difference(self.replay.shapes, self.replay.run(spec, aim)).numbers
        except NonFiniteState:
            return {"mean_per_coordinate": np.inf, "mean_distance": np.inf}

    def _frames(self) -> slice:
        step = float(np.median(np.diff(self.replay.shapes.time)))
        return slice(1, None, max(1, round(_SAMPLES / step)))

    def _free_points(self) -> List[int]:
        held = {number for numbers in self.replay.held for number in numbers}
        return [i for i in range(len(self.replay.shapes.places)) if i not in held]


class Problem:
    """Parameters to be fitted to windows of recordings.

    Args:
        parameters: what is fitted.
        windows: of all recordings.
        tell: called after each evaluation of all windows.
        each: like ``map``, for the windows.
    """

    def __init__(
        self,
        parameters: MaterialParameters,
        windows: Sequence[Window],
        tell: Callable[[], None] = lambda: None,
        each: Callable = map,
    ):
        self.parameters = parameters
        self.windows = list(windows)
        self._tell = tell
        self._each = each

    def residuals(self, vector: np.ndarray) -> List[np.ndarray]:
        """Of each window, see :meth:`Window.residuals`."""
        found = list(self._each(partial(_residuals, self.parameters, vector), self.windows))
        self._tell()
        return found

    def subset(self, windows: Sequence[Window]) -> "Problem":
        """The same with other windows."""
        return Problem(self.parameters, windows, self._tell, self._each)

    def mean_errors(self, vector: np.ndarray) -> List[dict]:
        """Numbers of :class:`.Difference` of each window."""
        return list(self._each(partial(_errors, self.parameters, vector), self.windows))


# The window last, and at the top level, so that processes can be sent the calls.
def _residuals(parameters: MaterialParameters, vector: np.ndarray, window: Window) -> np.ndarray:
    return window.residuals(parameters, vector)


def _errors(parameters: MaterialParameters, vector: np.ndarray, window: Window) -> Dict[str, float]:
    return window.errors(parameters, vector)


def windows_of(
    recordings: Sequence[MeasuredShapes],
    parameters: MaterialParameters,
    options: ReplayOptions,
    length: float,
) -> List[Window]:
    """Cut recordings into windows of a length [s]; what is left at an end is not used.

    Raises:
        MeasuredShapesError: a recording does not fit the object, or no window has three shapes.
    """
    windows = []
    for number, shapes in enumerate(recordings):
        for start in _starts(shapes.time, length):
            part = shapes.between(start, start + length)
            if len(part.time) > 2:
                windows.append(Window(number, Replay(parameters.spec, part, options)))
    if not windows:
        raise MeasuredShapesError(
            f"no window of {length:g} s has three shapes or more; use a longer --window, or longer "
            "recordings"
        )
    return windows


def _starts(time: np.ndarray, length: float) -> np.ndarray:
    """Starts [s] of the windows in which something was measured, one length after the other."""
    begin, end = time[0], time[-1]
    numbers = np.unique(np.floor((time - begin) / length))
    starts = begin + length * numbers
    return starts[starts <= max(end - length, begin) + 1e-9]
