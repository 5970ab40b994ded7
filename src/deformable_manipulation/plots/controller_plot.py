"""The paper's data plots: what one controller saw and decided, in one column's width."""

from itertools import cycle
from typing import Dict, List, Optional, Sequence, Tuple

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from deformable_manipulation.control.status import Status
from deformable_manipulation.plots.limits import (
    draw_distance,
    draw_limit,
    mark_violation,
    start_at_zero,
    with_lowest,
)
from deformable_manipulation.plots.style import (
    BLUE,
    COLUMN_WIDTH,
    MARGIN_LINES,
    ORANGE,
    STYLE,
    VIOLATION,
    legend_above,
    title_of,
)
from deformable_manipulation.recording.run_data import AssistantSeries, RunData
from deformable_manipulation.recording.timeseries import AXES
from deformable_manipulation.scenario.barriers import BARRIERS

PANEL_HEIGHT = 1.1  # in, with its legend
MARGIN_HEIGHT = 0.7  # in, legend above and time axis below the panels
MOVING = 1e-4  # m/s, velocity components that stay below are left out

# Background where the controller's status is one of these; the tones also differ in grey. The
# rare ones get an outline, so that a single cycle among thousands still shows.
SHADES = (
    ((Status.CONSTRAINED,), "filter active", "#DCEBF6", 0.0),
    ((Status.RELAXED,), "constraints relaxed", "#F3C27E", 0.5),
    ((Status.FAILED,), "no solution", "#C9664B", 0.5),
    ((Status.WAITING, Status.DISABLED), "stopped", "#D9D9D9", 0.5),
    ((Status.UNSAFE_FILTER_OFF,), "filter off", "#F0E4EE", 0.0),
)


def plot_controller(
    run: RunData, series: AssistantSeries, figure: Optional[Figure] = None
) -> Figure:
    """Draw the data plot of one controller of a run.

    Panels over a shared time axis: distance to the obstacle with its limit, norm of the tracking
    error, margins of the other barriers in a panel for each unit, and every moving component of
    the nominal and the commanded velocity and angular velocity. Shading shows what the safety
    filter did. Violations of a limit are filled and marked at their worst.

    Draws into ``figure`` when given (a window's), else into a new one without a window.
    """
    components = _moving_components(series)
    turning = _turning_components(series)
    units = _units(series)
    panels = 2 + len(units) + len(components) + len(turning)
    with rc_context(STYLE):
        figure = figure if figure is not None else Figure()
        figure.set_size_inches(COLUMN_WIDTH, MARGIN_HEIGHT + PANEL_HEIGHT * panels)
        figure.set_layout_engine("constrained", h_pad=0.02, w_pad=0.02, hspace=0.02)
        axes = figure.subplots(panels, 1, sharex=True)
        violated = draw_distance(axes[0], run, BLUE)
        axes[1].plot(series.time, series.error_norm, color=BLUE)
        axes[1].set_ylabel("error [m]")
        start_at_zero(axes[1])
        for axis, (unit, names) in zip(axes[2:], units.items()):
            violated |= _plot_margins(axis, series, unit, names)
        velocities = axes[2 + len(units) :]
        for axis, component in zip(velocities, components):
            _plot_velocity(axis, series, component)
        for axis, (name, nominal, command) in zip(velocities[len(components) :], turning):
            _plot_turning(axis, series.time, name, nominal, command)
        _legend_above(velocities[0])
        _finish_figure(figure, axes, run, series, violated)
    return figure


def _finish_figure(
    figure: Figure, axes, run: RunData, series: AssistantSeries, violated: bool
) -> None:
    """What the panels share: time axis, shading, title and legend of the figure."""
    axes[-1].set_xlabel("time [s]")
    axes[-1].set_xlim(*run.time_range)
    figure.align_ylabels(axes)
    handles = [
        Patch(facecolor=colour, label=label)
        for statuses, label, colour, outline in SHADES
        if _shade(axes, series, statuses, colour, outline)
    ]
    if violated:
        handles.append(Line2D([], [], label="violation", **VIOLATION))
    figure.legend(
        handles=handles,
        loc="outside upper center",
        ncols=max(1, len(handles)),
        title=title_of(run, series.agent),
        borderaxespad=0.4,
    )


def _units(series: AssistantSeries) -> Dict[str, List[str]]:
    """Names of the barriers by the units of their margins, but for that of the distance."""
    units: Dict[str, List[str]] = {"m": []}
    for name in series.h:
        if name != "collision":
            units.setdefault(_unit(name), []).append(name)
    return units


def _unit(name: str) -> str:
    """Recordings may have barriers that are not known here."""
    return BARRIERS[name].unit if name in BARRIERS else "m"


def _plot_margins(axis: Axes, series: AssistantSeries, unit: str, names: Sequence[str]) -> bool:
    """Draw the margins of barriers of one unit; true where one falls below zero."""
    axis.set_ylabel(f"margin [{unit}]")
    draw_limit(axis, 0.0)
    violated = False
    for name, (colour, style) in zip(names, cycle(MARGIN_LINES)):
        values = series.h[name]
        margin = np.where(np.isfinite(values), values, np.nan)
        if not np.isnan(margin).all():
            label = with_lowest(name, margin, unit)
            axis.plot(series.time, margin, color=colour, linestyle=style, label=label)
            violated |= mark_violation(axis, series.time, margin, 0.0)
    _legend_above(axis)
    return violated


def _plot_velocity(axis: Axes, series: AssistantSeries, component: int) -> None:
    nominal, command = series.nominal_velocity[:, component], series.command[:, component]
    axis.set_ylabel(f"velocity {AXES[component]} [m/s]")
    axis.plot(series.time, command, color=BLUE, label="commanded")
    axis.plot(series.time, nominal, color=ORANGE, linestyle="--", label="nominal")


def _plot_turning(
    axis: Axes, time: np.ndarray, name: str, nominal: np.ndarray, command: np.ndarray
) -> None:
    axis.set_ylabel(f"turning {name} [rad/s]")
    axis.plot(time, command, color=BLUE)
    axis.plot(time, nominal, color=ORANGE, linestyle="--")


def _legend_above(axis: Axes) -> None:
    legend_above(axis, *axis.get_legend_handles_labels())


def _shade(
    axes, series: AssistantSeries, statuses: Tuple[Status, ...], colour: str, outline: float
) -> bool:
    """Shade the times with one of the statuses in all panels; false if there are none."""
    intervals = _intervals(series.time, np.isin(series.status, statuses))
    for axis in axes:
        if intervals:
            axis.broken_barh(
                intervals,
                (0, 1),
                transform=axis.get_xaxis_transform(),
                facecolor=colour,
                edgecolor=colour,
                linewidth=outline,
                zorder=0,
            )
    return bool(intervals)


def _intervals(time: np.ndarray, active: np.ndarray) -> List[Tuple[float, float]]:
    """(start, duration) [s] of every stretch that is active; a sample lasts until the next."""
    edges = np.diff(np.concatenate(([False], active, [False])).astype(int))
    starts, ends = np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)
    ends = np.minimum(ends, len(time) - 1)
    return [(time[start], time[end] - time[start]) for start, end in zip(starts, ends)]


def _turning_components(
    series: AssistantSeries,
) -> List[Tuple[str, np.ndarray, np.ndarray]]:
    """Each axis about which the grip turns or would, with both velocities (M,) [rad/s]."""
    if series.turning is None:
        return []
    components = zip(AXES, series.turning.nominal.T, series.turning.command.T)
    return [
        (name, nominal, command)
        for name, nominal, command in components
        if np.abs(np.nan_to_num(np.concatenate((nominal, command)))).max() > MOVING
    ]


def _moving_components(series: AssistantSeries) -> List[int]:
    """Axes along which the assistant moves or would; all of them when it never does."""
    velocities = np.nan_to_num(np.concatenate((series.nominal_velocity, series.command)))
    moving = np.flatnonzero(np.abs(velocities).max(axis=0) > MOVING)
    return list(moving) if len(moving) else [0, 1, 2]
