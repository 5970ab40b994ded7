"""How far a replayed object is from the measured one."""

from dataclasses import dataclass
from typing import Dict, List

import numpy as np

from deformable_manipulation.replaying.measured_shapes import MeasuredShapes

CALM = 0.05  # m/s: slower than this, all points count as at rest
_CALM_TIME = 0.5  # s for which they have been so


@dataclass(frozen=True)
class Difference:
    """Of a recording; NaN where there is nothing to take a mean of.

    Attributes:
        time: (T,) s.
        mean: (T,) m, mean distance of the points, of those that were seen.
        worst: (T,) m, largest distance.
        calm: (T,) whether the measured object was at rest.
        numbers: the same over all, by name [m].
    """

    time: np.ndarray
    mean: np.ndarray
    worst: np.ndarray
    calm: np.ndarray
    numbers: Dict[str, float]


def difference(shapes: MeasuredShapes, predicted: np.ndarray) -> Difference:
    """Compare predicted points (T, M, 3) [m] with measured ones."""
    error = predicted - shapes.points
    distance = np.linalg.norm(error, axis=2)
    calm = calm_frames(shapes)
    numbers = {
        "mean_per_coordinate": _mean(np.abs(error)),
        "mean_distance": _mean(distance),
        "worst_distance": float(np.nanmax(distance)),
        "mean_distance_at_rest": _mean(distance[calm]),
        "mean_distance_moving": _mean(distance[~calm]),
    }
    with np.errstate(all="ignore"):
        mean = np.array([_mean(row) for row in distance])
        worst = np.array([np.nanmax(row) if np.isfinite(row).any() else np.nan for row in distance])
    return Difference(shapes.time, mean, worst, calm, numbers)


def calm_frames(shapes: MeasuredShapes) -> np.ndarray:
    """Frames (T,) in which all points have been slow for a while."""
    points = shapes.without_gaps()
    speed = np.linalg.norm(np.gradient(points, shapes.time, axis=0), axis=2).max(axis=1)
    last_quick = -np.inf
    calm = np.zeros(len(speed), dtype=bool)
    for frame, (time, fast) in enumerate(zip(shapes.time, speed >= CALM)):
        last_quick = time if fast else last_quick
        calm[frame] = time - max(last_quick, shapes.time[0]) >= _CALM_TIME
    return calm


def describe(numbers: Dict[str, float]) -> List[str]:
    """Lines of the numbers in mm."""
    return [
        "{:24} {}".format(
            name.replace("_", " "),
            "nothing to compare" if np.isnan(value) else f"{1000.0 * value:.1f} mm",
        )
        for name, value in numbers.items()
    ]


def _mean(values: np.ndarray) -> float:
    finite = values[np.isfinite(values)]
    return float(finite.mean()) if finite.size else float("nan")
