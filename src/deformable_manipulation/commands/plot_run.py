"""Makes the paper's data plots from a recorded run."""

import argparse
import sys
from pathlib import Path
from typing import Dict, List, Optional, Sequence

from deformable_manipulation.commands.arguments import folder_name, times_of
from deformable_manipulation.recording import RunData, RunDataError, read_run
from deformable_manipulation.recording.frames import read_frames

FORMATS = ("png", "pdf", "svg")
DESCRIPTION = """Make the data plots of a run. One figure per controller: distance with its offset
(cut off at five times that), tracking error, margins to overstretch and proximity,
nominal and commanded velocity. One overview: overlaid snapshots of obstacles, object and agents,
the places that the assistants would keep, and distance, errors and margins of all of them."""
EXAMPLES = """examples:
  plot_run output/rope_one_assistant_20250131_120000
  plot_run run.bag --output figures --format png,pdf
  plot_run output/trial --times 30,60,130,160
  plot_run output/run.bag --namespace left --show
"""


def main(argv: Optional[Sequence[str]] = None) -> int:
    """Run the command; returns its exit code."""
    arguments = _parse(argv)
    try:
        run = read_run(arguments.path, arguments.namespace)
    except RunDataError as error:
        print(f"plot_run: {error}", file=sys.stderr)
        return 1
    for note in run.notes:
        print(f"note: {note}", file=sys.stderr)
    if arguments.times and max(arguments.times) > run.time[-1] + 1e-9:
        print(
            f"plot_run: --times: {max(arguments.times):g} s is after the end of the run; "
            f"allowed: 0 to {run.time[-1]:g} s",
            file=sys.stderr,
        )
        return 1
    figures = _draw(run, arguments.times, arguments.show)
    try:
        _save(run, figures, arguments.output, arguments.format)
    except OSError as error:
        print(f"plot_run: cannot write the figures: {error}", file=sys.stderr)
        return 1
    if arguments.show:
        _show()
    return 0


def _parse(argv: Optional[Sequence[str]]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="plot_run",
        description=DESCRIPTION,
        epilog=EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("path", help="run folder, bag, or folder that holds one bag")
    parser.add_argument(
        "--output",
        metavar="DIR",
        type=folder_name,
        help="where to write (default: beside the run)",
    )
    parser.add_argument(
        "--format",
        type=_formats,
        default=["png"],
        metavar="FORMATS",
        help="one or more of {}, separated by commas (default: png)".format(", ".join(FORMATS)),
    )
    parser.add_argument(
        "--times",
        type=times_of,
        metavar="T1,T2,...",
        help="seconds at which the overview shows the object (default: telling ones)",
    )
    parser.add_argument("--namespace", help="which run, where a bag holds several side by side")
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
    # Imported late: matplotlib takes longer to load than a wrong path to be told.
    from deformable_manipulation.overview_plot import plot_overview
    from deformable_manipulation.plotting import plot_controller

    figures = {}
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


def _save(run: RunData, figures, output: Optional[Path], formats: Sequence[str]) -> None:
    from deformable_manipulation.plotting import save_figure

    is_folder = run.path.is_dir()
    folder = output or (run.path if is_folder else run.path.parent)
    folder.mkdir(parents=True, exist_ok=True)
    prefix = "" if is_folder else run.name + "_"
    for name, figure in figures.items():
        for ending in formats:
            path = folder / f"{prefix}{name}.{ending}"
            save_figure(figure, path)
            print(path)


def _show() -> None:
    import matplotlib
    from matplotlib import pyplot

    if matplotlib.get_backend().lower() == "agg":
        print("plot_run: no display to show the figures on", file=sys.stderr)
        return
    pyplot.show()


if __name__ == "__main__":
    sys.exit(main())
