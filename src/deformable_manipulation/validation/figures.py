"""The figure of a case: its panels side by side."""

from io import BytesIO
from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from PIL import Image

from deformable_manipulation.plots.style import BLACK, BLUE, GREEN, ORANGE, STYLE, VERMILLION
from deformable_manipulation.validation.result import CaseResult, Curve, Panel

RESOLUTION = 100  # dots per inch
NUANCES = 128  # colours of a figure
PANEL_SIZE = (4.2, 2.9)  # in
COLUMNS = 2
COLOURS = (BLUE, VERMILLION, GREEN, ORANGE, "#CC79A7", "#56B4E9")
MARKS = ("o", "s", "^", "v", "D", "x")
SIZES = {"font.size": 8, "axes.labelsize": 8, "legend.fontsize": 7, "lines.linewidth": 1.0}


def draw(case: CaseResult) -> Figure:
    """Draw all panels of a case."""
    rows = -(-len(case.panels) // COLUMNS)
    with rc_context({**STYLE, **SIZES}):
        figure = Figure(figsize=(COLUMNS * PANEL_SIZE[0], rows * PANEL_SIZE[1]))
        for index, panel in enumerate(case.panels):
            _draw_panel(figure.add_subplot(rows, COLUMNS, index + 1), panel)
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
    if panel.equal:
        axes.set_aspect("equal", adjustable="datalim")
    axes.legend()


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
