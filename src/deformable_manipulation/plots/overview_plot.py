"""One figure for a whole run: where everything was, and how near to the limits."""

from itertools import cycle
from typing import List, Optional, Sequence

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from deformable_manipulation.plots.controller_plot import DISTANCE_RANGE
from deformable_manipulation.plots.snapshot_plot import COLOURS, SnapshotPlot
from deformable_manipulation.plots.style import BLACK, COLUMN_WIDTH, STYLE, legend_above, title_of
from deformable_manipulation.recording.frames import Frames
from deformable_manipulation.recording.run_data import RunData

_VIEW_WIDTH, _PANEL_HEIGHT = 2.9, 1.0  # in
_VIEW_HEIGHTS = (1.2, 3.6)  # in, least and most
_AROUND = 0.6  # in, titles and labels
_STYLES = ("-", "--", "-.", ":")
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
        _plot_distance(distance, run)
        _plot_errors(error, run)
        _plot_margins(margin, run)
        for axis in (distance, error, margin):
            axis.set_xlim(*run.time_range)
            axis.tick_params(labelbottom=axis is margin)
            for time, colour in zip(chosen, cycle(COLOURS)):
                axis.axvline(time, color=colour, linewidth=0.8, zorder=0)
        margin.set_xlabel("time [s]")
        figure.align_ylabels((view, distance, error, margin))
        figure.suptitle(title_of(run), fontsize=STYLE["font.size"])
        legend_above(
            view,
            [Line2D([], [], color=colour) for _, colour in zip(chosen, cycle(COLOURS))],
            [f"{time:g} s" for time in chosen],
        )
    return figure


def snapshot_times(run: RunData) -> List[float]:
    """Times [s] that show what a run is about, in their order and well apart."""
    time = run.time
    moments = [float(time[0])]
    errors = [(np.nanmax(each.error_norm), each) for each in run.assistants if len(each.time)]
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


def _plot_distance(axis, run: RunData) -> None:
    distance = np.where(np.isfinite(run.distance), run.distance, np.nan)
    axis.plot(run.time, distance, color=COLOURS[0])
    axis.set_ylabel("distance [m]")
    if run.offset is not None:
        axis.axhline(run.offset, color=BLACK, linestyle="--", linewidth=0.8)
        top = DISTANCE_RANGE * run.offset
        known = np.isfinite(distance).any()
        if known and max(0.0, np.nanmin(distance)) < top < np.nanmax(distance):
            axis.set_ylim(top=top)


def _plot_errors(axis, run: RunData) -> None:
    for series, style in zip(run.assistants, _STYLES * len(run.assistants)):
        axis.plot(series.time, series.error_norm, style, color=COLOURS[0], label=series.agent)
    axis.set_ylabel("error [m]")
    axis.set_ylim(bottom=0.0)
    if len(run.assistants) > 1:
        legend_above(axis, *axis.get_legend_handles_labels())


def _plot_margins(axis, run: RunData) -> None:
    axis.axhline(0.0, color=BLACK, linestyle="--", linewidth=0.8)
    for series, style in zip(run.assistants, _STYLES * len(run.assistants)):
        if "overstretch" in series.h:
            axis.plot(series.time, series.h["overstretch"], style, color=COLOURS[2])
    axis.set_ylabel("overstretch\nmargin [m]")
