"""The figure of a case: its panels side by side."""

from io import BytesIO
from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter
from PIL import Image

from deformable_manipulation.plots.style import BLACK, BLUE, GREEN, ORANGE, STYLE, VERMILLION
from deformable_manipulation.validation.result import CaseResult, Curve, Panel

RESOLUTION = 100  # dots per inch
NUANCES = 128  # colours of a figure
PANEL_SIZE = (4.2, 2.9)  # in
COLUMNS = 2
COLOURS = (BLUE, VERMILLION, GREEN, ORANGE, "#CC79A7", "#56B4E9")
MARKS = ("o", "s", "^", "v", "D", "x")
_DECADES = 100.0  # ratio of the ends of an axis; longer ones have powers of ten
SIZES = {"font.size": 8, "axes.labelsize": 8, "legend.fontsize": 7, "lines.linewidth": 1.0}


def draw(case: CaseResult) -> Figure:
    """Draw all panels of a case."""
    columns = min(COLUMNS, len(case.panels))
    rows = -(-len(case.panels) // columns)
    with rc_context({**STYLE, **SIZES}):
        figure = Figure(figsize=(columns * PANEL_SIZE[0], rows * PANEL_SIZE[1]))
        for index, panel in enumerate(case.panels):
            _draw_panel(figure.add_subplot(rows, columns, index + 1), panel)
        figure.tight_layout()
    return figure


def save(figure: Figure, path: Path) -> None:
    """Write a PNG of few colours, which is small; the folder must be there."""
    drawn = BytesIO()
    with rc_context({**STYLE, **SIZES}):
        figure.savefig(drawn, dpi=RESOLUTION, format="png")
    with Image.open(drawn) as image:
        image.convert("RGB").quantize(NUANCES, Image.Quantize.MAXCOVERAGE).save(path, optimize=True)


def _draw_panel(axes: Axes, panel: Panel) -> None:
    simulated = [curve for curve in panel.curves if not curve.theory]
    for curve in panel.curves:
        if curve.theory:
            axes.plot(curve.x, curve.y, color=BLACK, label=curve.label or "_", zorder=1)
    for index, curve in enumerate(simulated):
        _draw_marks(axes, curve, index)
    if panel.limit is not None:
        label = f"tolerance {panel.limit:g}" if panel.limit else "_"
        axes.axhline(panel.limit, color=BLACK, linestyle=":", label=label)
    axes.set_title(panel.title, fontsize=8)
    axes.set_xlabel(panel.x_label)
    axes.set_ylabel(panel.y_label)
    axes.set_xscale(panel.x_scale)
    axes.set_yscale(panel.y_scale)
    if panel.x_scale == "log":
        _tell_decimals(axes)
    if panel.equal:
        axes.set_aspect("equal", adjustable="datalim")
    axes.legend()


def _tell_decimals(axes: Axes) -> None:
    """Numbers such as 45 along a logarithmic axis of less than two decades, not powers of ten."""
    low, high = axes.get_xlim()
    if high / low < _DECADES:
        ticks = [digit * 10.0**power for power in range(-4, 5) for digit in (1, 2, 5)]
        axes.set_xticks([tick for tick in ticks if low <= tick <= high])
        axes.xaxis.set_major_formatter("{x:g}")
        axes.xaxis.set_minor_formatter(NullFormatter())


def _draw_marks(axes: Axes, curve: Curve, index: int) -> None:
    axes.plot(
        curve.x,
        curve.y,
        color=COLOURS[index % len(COLOURS)],
        marker=MARKS[index % len(MARKS)],
        markersize=3,
        markevery=max(1, len(np.atleast_1d(curve.x)) // 30),
        linewidth=0.6,
        label=curve.label or "_",
    )
