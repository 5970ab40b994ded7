"""What all figures share: sizes, colours, titles, legends and how they are written."""

from typing import Sequence

from matplotlib import rc_context
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from deformable_manipulation.recording.run_data import RunData

COLUMN_WIDTH = 3.5  # in, one column of a two-column paper
RESOLUTION = 300  # dots per inch of pixel formats
_LEGEND_LINE, _LEGEND_HANDLE = 58, 5  # letters, that fit above a panel and in place of a handle

# Colours that people with any common colour vision deficiency tell apart (Okabe and Ito).
BLACK = "#000000"
BLUE = "#0072B2"
ORANGE = "#E69F00"
GREEN = "#009E73"
VERMILLION = "#D55E00"
MARGIN_LINES = ((GREEN, "-"), (ORANGE, "-."), (BLUE, "--"), (BLACK, ":"))
# In an order in which neighbours differ in lightness, too.
_SERIES = (BLUE, VERMILLION, GREEN, "#CC79A7", "#56B4E9", ORANGE, BLACK)
VIOLATION = {"color": VERMILLION, "marker": "v", "markersize": 4, "linestyle": "none"}

# Sizes in points, at COLUMN_WIDTH; papers ask for 8 or so.
STYLE = {
    "font.size": 8,
    "axes.labelsize": 8,
    "axes.linewidth": 0.6,
    "axes.axisbelow": True,
    "axes.grid": True,
    "grid.linewidth": 0.4,
    "grid.color": "#CCCCCC",
    "xtick.labelsize": 7.5,
    "ytick.labelsize": 7.5,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "legend.fontsize": 7.5,
    "legend.title_fontsize": 8,
    "legend.frameon": False,
    "legend.handlelength": 1.6,
    "legend.handletextpad": 0.4,
    "legend.columnspacing": 1.2,
    "legend.borderpad": 0.0,
    "legend.borderaxespad": 0.1,
    "legend.labelspacing": 0.25,
    "lines.linewidth": 0.9,
    "pdf.fonttype": 42,  # publishers refuse the default, type 3
    "ps.fonttype": 42,
}


def colour_of(number: int) -> str:
    """The colour of one of several times, counted from 0; the first seven differ."""
    return _SERIES[number % len(_SERIES)]


def save_figure(figure: Figure, path) -> None:
    """Write a figure in the format its name's ending tells (png, pdf, svg).

    Raises OSError; ValueError: unknown format.
    """
    with rc_context(STYLE):
        figure.savefig(str(path), dpi=RESOLUTION)


def title_of(run: RunData, what: str = "") -> str:
    """Title of a figure: the scenario, and a warning where the run's shapes mean nothing."""
    name = run.scenario or run.name
    title = f"{name}: {what}" if what else name
    if run.max_stretch is None or run.max_stretch <= run.valid_stretch:
        return title
    return f"{title}\nNOT VALID: object stretched by up to {100.0 * run.max_stretch:.1f} %"


def legend_above(axis: Axes, handles: Sequence[Artist], labels: Sequence[str]) -> None:
    """A legend above a panel, where it hides no data: in one line, or more where names are long."""
    if handles:
        letters = max(map(len, labels)) + _LEGEND_HANDLE
        columns = min(len(handles), max(1, _LEGEND_LINE // letters))
        axis.legend(handles, labels, loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=columns)
