"""How all figures draw quantities that have a limit: the limit, the lowest value, violations."""

import numpy as np
from matplotlib.axes import Axes

from deformable_manipulation.geometry.lengths import millimetres
from deformable_manipulation.plots.style import BLACK, VIOLATION, legend_above
from deformable_manipulation.recording.run_data import RunData

# Farther than this many limits from the obstacle, distances say nothing about safety, and showing
# them would hide a violation of some millimetres.
_DISTANCE_RANGE = 5.0
_LEAST_RANGE = 0.01  # m; a smaller one would show rounding errors as if they mattered


def draw_distance(axis: Axes, run: RunData, colour: str) -> bool:
    """Draw the distance to the obstacles and its limit; true where it falls below the limit."""
    axis.set_ylabel("distance [m]")
    if not np.isfinite(run.distance).any():
        axis.text(0.5, 0.5, "no obstacle", ha="center", va="center", transform=axis.transAxes)
        return False
    distance = np.where(np.isfinite(run.distance), run.distance, np.nan)
    axis.plot(run.time, distance, color=colour, label=with_lowest("distance", distance))
    violated = False
    if run.offset is not None:
        draw_limit(axis, run.offset, f"limit {millimetres(run.offset)}")
        violated = mark_violation(axis, run.time, distance, run.offset)
        top = _DISTANCE_RANGE * run.offset
        if max(0.0, np.nanmin(distance)) < top < np.nanmax(distance):
            axis.set_ylim(top=top)
    legend_above(axis, *axis.get_legend_handles_labels())
    return violated


def draw_limit(axis: Axes, limit: float, label: str = "") -> None:
    """A dashed line at a limit."""
    axis.axhline(limit, color=BLACK, linestyle="--", linewidth=0.8, label=label)


def mark_violation(axis: Axes, time: np.ndarray, values: np.ndarray, limit: float) -> bool:
    """Fill what lies below a limit and mark the lowest point; false if nothing does."""
    below = np.nan_to_num(values, nan=np.inf) < limit
    if not below.any():
        return False
    colour = VIOLATION["color"]
    axis.fill_between(time, values, limit, where=below, color=colour, linewidth=0.8)
    worst = np.nanargmin(values)
    axis.plot(time[worst], values[worst], **VIOLATION)
    return True


def start_at_zero(axis: Axes) -> None:
    """Show values from zero up; those that are zero but for rounding look like zero."""
    axis.set_ylim(bottom=0.0, top=max(axis.get_ylim()[1], _LEAST_RANGE))


def with_lowest(name: str, values: np.ndarray, unit: str = "m") -> str:
    """A label with the lowest of some lengths [m], or of values of another unit."""
    lowest = float(np.nanmin(values))
    text = millimetres(lowest) if unit == "m" else f"{lowest:.3g} {unit}"
    return f"{name} (min {text})"
