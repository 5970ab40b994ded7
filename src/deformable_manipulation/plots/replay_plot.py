"""The figure of a replayed recording: shapes at four times, and the difference over time."""

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure

from deformable_manipulation.plots.style import (
    BLUE,
    COLUMN_WIDTH,
    ORANGE,
    STYLE,
    VERMILLION,
    colour_of,
)
from deformable_manipulation.replaying.difference import Difference
from deformable_manipulation.replaying.measured_shapes import MeasuredShapes

_TIMES = 4


def plot_replay(shapes: MeasuredShapes, predicted: np.ndarray, found: Difference) -> Figure:
    """Draw measured points (dots) and predicted ones, seen from the widest side.

    Predicted points are lines along a rod, and crosses on a fabric.

    predicted: (T, M, 3) m.
    """
    with rc_context(STYLE):
        figure = Figure(figsize=(COLUMN_WIDTH, 1.3 * COLUMN_WIDTH), layout="constrained")
        seen, over_time = figure.subplots(2, 1, height_ratios=(1.4, 1.0))
        _draw_shapes(seen, shapes, predicted)
        _draw_difference(over_time, found)
    return figure


def _draw_shapes(axes, shapes, predicted) -> None:
    across = _widest_direction(predicted)
    marks, name = ("-", "lines") if shapes.places.ndim == 1 else ("x", "crosses")
    frames = np.linspace(0, len(shapes.time) - 1, _TIMES).astype(int)
    for number, frame in enumerate(frames):
        colour = colour_of(number)
        for points, style in ((shapes.points, "o"), (predicted, marks)):
            along, up = points[frame] @ across, points[frame, :, 2]
            label = f"{shapes.time[frame]:.1f} s" if style == marks else None
            axes.plot(along, up, style, color=colour, markersize=2.5, label=label)
    axes.set(xlabel="horizontal [m]", ylabel="z [m]", aspect="equal", adjustable="datalim")
    _put_legend_above(axes, f"dots measured, {name} predicted")


def _widest_direction(points: np.ndarray) -> np.ndarray:
    """Horizontal unit vector (3,) along which points (..., 3) spread most."""
    level = points.reshape(-1, 3)[:, :2]
    _, vectors = np.linalg.eigh(np.cov(level.T))
    return np.array((*vectors[:, 1], 0.0))


def _draw_difference(axes, found: Difference) -> None:
    axes.plot(found.time, 1000.0 * found.worst, color=VERMILLION, label="worst point")
    axes.plot(found.time, 1000.0 * found.mean, color=BLUE, label="mean")
    axes.set(xlabel="time [s]", ylabel="distance [mm]", ylim=(0.0, None))
    low, high = axes.get_ylim()
    axes.fill_between(
        found.time, low, high, where=found.calm, color=ORANGE, alpha=0.2, lw=0, label="at rest"
    )
    axes.set_ylim(low, high)
    _put_legend_above(axes)


def _put_legend_above(axes, title=None) -> None:
    axes.legend(title=title, ncols=4, loc="lower center", bbox_to_anchor=(0.5, 1.01))
