"""One figure for a whole run: where everything was, and how near to the limits."""

from itertools import cycle
from typing import Any, Dict, List, Optional, Sequence

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from deformable_manipulation.plots.limits import draw_distance, draw_limit, start_at_zero
from deformable_manipulation.plots.snapshot_plot import SnapshotPlot
from deformable_manipulation.plots.style import (
    BLACK,
    COLUMN_WIDTH,
    STYLE,
    colour_of,
    legend_above,
    title_of,
)
from deformable_manipulation.recording.frames import Frames
from deformable_manipulation.recording.run_data import RunData

_VIEW_WIDTH, _PANEL_HEIGHT = 2.9, 1.0  # in
_VIEW_HEIGHTS = (1.2, 3.6)  # in, least and most
_AROUND = 0.6  # in, titles and labels
_GREY = "#8C8C8C"
# Of the assistants. Colours are for times here, and dashes for limits.
_STYLES: Sequence[Dict[str, Any]] = (
    {"color": BLACK, "linestyle": "-"},
    {"color": _GREY, "linestyle": "-", "linewidth": 2.0, "zorder": 1.9},
    {"color": BLACK, "linestyle": ":"},
    {"color": _GREY, "linestyle": ":"},
)
_SNAPSHOTS = 4
_APART = 0.06  # of the run's length: nearer snapshots would hide each other


def plot_overview(
    run: RunData,
    frames: Frames,
    times: Optional[Sequence[float]] = None,
    figure: Optional[Figure] = None,
) -> Figure:
    """Overlaid snapshots above distance, errors and margins over time.

    Args:
        times: of the snapshots [s]; None: the start, the lowest distance, the largest error, and
            others between.
    """
    chosen = sorted(times) if times else snapshot_times(run)
    with rc_context(STYLE):
        figure = figure if figure is not None else Figure()
        figure.set_layout_engine("constrained", h_pad=0.02, w_pad=0.02)
        view, distance, error, margin = figure.subplots(4, 1)
        snapshots = SnapshotPlot(frames, view)
        height = float(np.clip(_VIEW_WIDTH * snapshots.height_per_width(chosen), *_VIEW_HEIGHTS))
        view.get_gridspec().set_height_ratios((height, *(3 * (_PANEL_HEIGHT,))))
        figure.set_size_inches(COLUMN_WIDTH, height + 3 * _PANEL_HEIGHT + _AROUND)
        snapshots.draw(chosen)
        draw_distance(distance, run, BLACK)
        _plot_errors(error, run)
        _plot_margins(margin, run)
        for axis in (distance, error, margin):
            axis.set_xlim(*run.time_range)
            axis.tick_params(labelbottom=axis is margin)
            for number, time in enumerate(chosen):
                axis.axvline(time, color=colour_of(number), linewidth=0.8, zorder=0)
        margin.set_xlabel("time [s]")
        figure.align_ylabels((view, distance, error, margin))
        figure.legend(
            handles=_roles(),
            loc="outside upper center",
            ncols=3,
            title=title_of(run),
            borderaxespad=0.4,
        )
        legend_above(
            view,
            [Line2D([], [], color=colour_of(number)) for number in range(len(chosen))],
            [f"{time:g} s" for time in chosen],
        )
    return figure


def snapshot_times(run: RunData) -> List[float]:
    """Times [s] that show what a run is about, in their order and well apart."""
    time = run.time
    moments = [float(time[0])]
    known = [each for each in run.assistants if np.isfinite(each.error_norm).any()]
    errors = [(np.nanmax(each.error_norm), each) for each in known]
    if errors:
        _, worst = max(errors, key=lambda pair: pair[0])
        moments.append(float(worst.time[np.nanargmax(worst.error_norm)]))
    if np.isfinite(run.distance).any():
        moments.append(float(time[np.nanargmin(run.distance)]))
    moments += [float(time[len(time) * quarter // 4]) for quarter in (2, 1, 3)]
    chosen = []
    for moment in moments:
        if all(abs(moment - other) > _APART * np.ptp(time) for other in chosen):
            chosen.append(moment)
    return sorted(round(moment, 1) for moment in chosen[:_SNAPSHOTS])


def _plot_errors(axis, run: RunData) -> None:
    for series, style in zip(run.assistants, cycle(_STYLES)):
        axis.plot(series.time, series.error_norm, **style, label=series.agent)
    axis.set_ylabel("error [m]")
    start_at_zero(axis)
    if len(run.assistants) > 1:
        legend_above(axis, *axis.get_legend_handles_labels())


def _plot_margins(axis, run: RunData) -> None:
    draw_limit(axis, 0.0)
    for series, style in zip(run.assistants, cycle(_STYLES)):
        if "overstretch" in series.h:
            axis.plot(series.time, series.h["overstretch"], **style)
    axis.set_ylabel("overstretch\nmargin [m]")


def _roles() -> List[Line2D]:
    """Legend of the marks of the snapshots."""
    style = {"linestyle": "none", "markersize": 4, "markeredgecolor": BLACK}
    return [
        Line2D([], [], marker=marker, color=colour, label=label, **style)
        for marker, colour, label in (
            ("s", _GREY, "leader"),
            ("o", _GREY, "assistant"),
            ("o", "white", "place to keep"),
        )
    ]
