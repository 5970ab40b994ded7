"""Makes the paper's data plots from a recorded run."""

import argparse
import sys
from pathlib import Path
from typing import Dict, List, Optional, Sequence

from deformable_manipulation.commands.arguments import command_parser, folder_name, times_of
from deformable_manipulation.commands.failure import fail
from deformable_manipulation.commands.output_folder import writable_folder
from deformable_manipulation.recording import RunData, RunDataError, read_run
from deformable_manipulation.recording.frame_reader import read_frames
from deformable_manipulation.recording.summary import describe_recorded

NAME = "plot_run"
FORMATS = ("png", "pdf", "svg")
DESCRIPTION = """Draw the data plots of a run. One figure per controller: distance and its offset
(cut off at five times the offset), tracking error, margins of all other barriers in use, such as
overstretch, proximity and workspace, nominal and commanded velocity. One overview: overlaid
snapshots of obstacles, object and agents, the places that the assistants should keep, and distance,
errors and overstretch margins of all assistants. The figures fit one column of a paper (3.5 in,
8-point text), as PNG and as PDF."""
EXAMPLES = """examples:
  plot_run output/rope_one_assistant_20250131_120000
  plot_run run.bag --output figures --format pdf
  plot_run output/trial --times 30,60,130,160
  plot_run output/run.bag --namespace left --show
"""


def main(argv: Optional[Sequence[str]] = None) -> int:
    """Run the command; returns its exit code."""
    arguments = _parse(argv)
    try:
        run = read_run(arguments.path, arguments.namespace)
    except RunDataError as error:
        return fail(NAME, str(error))
    for note in run.notes:
        print(f"note: {note}", file=sys.stderr)
    end = run.time_range[1]
    if arguments.times and max(arguments.times) > end:
        return fail(
            NAME,
            f"--times: {max(arguments.times):g} s is after the end of the run; "
            f"allowed: 0 to {end:g} s",
        )
    try:
        folder = _output_folder(run, arguments.output)
        figures = _draw(run, arguments.times, arguments.show)
        prefix = "" if run.path.is_dir() else f"{run.name}_"
        paths = _save(figures, folder, prefix, arguments.format)
    except OSError as error:
        return fail(NAME, f"cannot write the figures: {error}")
    for path in paths:
        print(path)
    if arguments.numbers:
        print(describe_recorded(run))
    if arguments.show:
        _show()
    return 0


def _parse(argv: Optional[Sequence[str]]) -> argparse.Namespace:
    parser = command_parser(NAME, DESCRIPTION, EXAMPLES)
    parser.add_argument("path", help="run folder, bag, or folder that holds one bag")
    parser.add_argument(
        "--output",
        metavar="DIR",
        type=folder_name,
        help="output folder (default: next to the run)",
    )
    parser.add_argument(
        "--format",
        type=_formats,
        default=["png", "pdf"],
        metavar="FORMATS",
        help="one or more of {}, separated by commas (default: png,pdf)".format(", ".join(FORMATS)),
    )
    parser.add_argument(
        "--times",
        type=times_of,
        metavar="T1,T2,...",
        help="times [s] at which the overview shows the object (default: characteristic times)",
    )
    parser.add_argument("--namespace", help="which run, if the bag holds several")
    parser.add_argument(
        "--numbers", action="store_true", help="also print lowest distance, margins and errors"
    )
    parser.add_argument("--show", action="store_true", help="also open the figures in windows")
    return parser.parse_args(argv)


def _formats(text: str) -> List[str]:
    names = [name.strip().lower() for name in text.split(",")]
    unknown = [name for name in names if name not in FORMATS]
    if unknown:
        raise argparse.ArgumentTypeError(
            "unknown format '{}'; allowed: {}".format("', '".join(unknown), ", ".join(FORMATS))
        )
    return names


def _draw(run: RunData, times: Optional[Sequence[float]], show: bool) -> Dict[str, object]:
    """Figures by the names of their files."""
    # Imported late: matplotlib loads slowly, and a wrong path is reported at once.
    from deformable_manipulation.plots.controller_plot import plot_controller
    from deformable_manipulation.plots.overview_plot import plot_overview

    figures: Dict[str, object] = {}
    for series in run.assistants:
        window = _window(f"{run.name}: {series.agent}") if show else None
        figures[f"controller_{series.agent}"] = plot_controller(run, series, window)
    try:
        frames = read_frames(run)
    except RunDataError as error:
        print(f"note: no overview: {error}", file=sys.stderr)
    else:
        window = _window(run.name) if show else None
        figures["overview"] = plot_overview(run, frames, times, window)
    return figures


def _window(title: str):
    from matplotlib import pyplot

    return pyplot.figure(title)


def _output_folder(run: RunData, output: Optional[Path]) -> Path:
    beside = run.path if run.path.is_dir() else run.path.parent
    return writable_folder(output or beside)


def _save(figures, folder: Path, prefix: str, formats: Sequence[str]) -> List[Path]:
    from deformable_manipulation.plots.style import save_figure

    paths = []
    for name, figure in figures.items():
        for ending in formats:
            paths.append(folder / f"{prefix}{name}.{ending}")
            save_figure(figure, paths[-1])
    return paths


def _show() -> None:
    import matplotlib
    from matplotlib import pyplot

    if matplotlib.get_backend().lower() == "agg":
        fail(NAME, "no display to show the figures on")
        return
    pyplot.show()
