"""A campaign in one picture."""

from typing import Sequence

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure
from matplotlib.ticker import SymmetricalLogLocator

from deformable_manipulation.campaign.outcome import RunOutcome
from deformable_manipulation.geometry.lengths import millimetres
from deformable_manipulation.plots.style import BLUE, COLUMN_WIDTH, STYLE, VERMILLION, legend_above

_PANELS = (
    ("clearance", "lowest distance\nminus limit [mm]"),
    ("oscillation", "oscillation,\nRMS [mm]"),
    ("final_error", "error at\nthe end [mm]"),
)
_HEIGHT = 3.4  # in
_LINEAR = 10.0  # mm; beyond it an axis is logarithmic
_LEAST_RANGE = 1.0  # mm; a smaller one would show rounding errors as if they mattered


def plot_campaign(outcomes: Sequence[RunOutcome], offset: float, name: str) -> Figure:
    """Empirical distributions over the runs; a dashed line is at the limit of the distance.

    Args:
        offset: distance to keep [m].
    """
    values = {
        "clearance": _finite([outcome.min_distance - offset for outcome in outcomes]),
        "oscillation": _finite([outcome.oscillation for outcome in outcomes]),
        "final_error": _finite([outcome.final_error for outcome in outcomes]),
    }
    with rc_context(STYLE):
        figure = Figure(figsize=(COLUMN_WIDTH, _HEIGHT), layout="constrained")
        axes = figure.subplots(len(_PANELS), 1)
        for axis, (key, label) in zip(axes, _PANELS):
            lengths = np.sort(1e3 * values[key])
            share = (np.arange(len(lengths)) + 1.0) / max(len(lengths), 1)
            axis.step(lengths, share, where="post", color=BLUE)
            axis.set_xlabel(label.replace("\n", " "))
            axis.set_ylabel("share of runs")
            axis.set_ylim(0.0, 1.02)
            if np.abs(lengths).max(initial=0.0) > _LINEAR:
                axis.set_xscale("symlog", linthresh=_LINEAR)
                axis.xaxis.set_major_locator(SymmetricalLogLocator(base=10.0, linthresh=_LINEAR))
                axis.xaxis.set_major_formatter("{x:g}")
            axis.margins(x=0.05)
        limit = f"limit {millimetres(offset)}"
        axes[0].axvline(0.0, color=VERMILLION, linestyle="--", linewidth=0.8, label=limit)
        legend_above(axes[0], *axes[0].get_legend_handles_labels())
        for axis in axes[1:]:
            axis.set_xlim(-0.05 * _LEAST_RANGE, max(axis.get_xlim()[1], _LEAST_RANGE))
        figure.suptitle(f"{name}: {len(outcomes)} runs")
    return figure


def _finite(values) -> np.ndarray:
    values = np.array(values, dtype=float)
    return values[np.isfinite(values)]
