"""Makes the pictures and the video of ``rviz_snapshot``."""

import argparse
import sys
from functools import partial
from pathlib import Path
from typing import Iterator, List, Optional, Sequence, Tuple

import numpy as np

from deformable_manipulation.commands.progress import ProgressDisplay
from deformable_manipulation.commands.snapshot_arguments import (
    NAME,
    OVERLAID,
    SEPARATE,
    SIDE_BY_SIDE,
)
from deformable_manipulation.commands.snapshot_source import SnapshotSource
from deformable_manipulation.pictures.picture import save_png
from deformable_manipulation.pictures.picture_layout import (
    INK,
    is_alike,
    labelled,
    overlaid,
    side_by_side,
)
from deformable_manipulation.pictures.video_file import RATE, video_file
from deformable_manipulation.ros.label_marker import NAMESPACE as LABELS
from deformable_manipulation.ros.label_marker import time_labels
from deformable_manipulation.ros.obstacle_markers import DISTANCE_LABELS, MOVING_OBSTACLES
from deformable_manipulation.ros.rviz_view import without

VIDEO_LENGTH = 20.0  # s, unless a speed is given
_TIME_LETTERS, _ROW_LETTERS, _LETTERS = 1 / 12, 1 / 20, 1 / 28  # of the pictures' height
_DISTANCE_COLOR = (191, 0, 140)  # as the line is drawn

# Distances are told in a corner, where nothing hides them. Not shown where several times are in one
# picture: letters that would be too small to be read, and what would hide other times. The trails
# are below the rest.
_SMALL = (DISTANCE_LABELS, "agent_names", "copy_distances")
_CROWDED = (*_SMALL, "distances", "copies")
_TRAILS = "trails"
_LOOKS = 15  # in a row, at a picture that may stay empty, for one at rest
_MOVING = ("object", "object_lines", "agents", MOVING_OBSTACLES)


def picture_name(scenario: str, times: Sequence[float], layout: str = SEPARATE) -> str:
    """A picture's file name, such as ``rope_t060.png`` or ``rope_t007.25_t060_overlaid.png``."""
    texts = []
    for time in times:
        whole, _, fraction = f"{time:.3f}".partition(".")
        fraction = fraction.rstrip("0")
        texts.append("_t{:0>3}{}".format(whole, "." + fraction if fraction else ""))
    return scenario + "".join(texts) + ("" if layout == SEPARATE else f"_{layout}") + ".png"


def film_times(first: float, last: float, speed: Optional[float]) -> Tuple[np.ndarray, float]:
    """The times [s] of a video's pictures, and the speed, as a multiple of the run's own."""
    speed = speed or max(1.0, (last - first) / VIDEO_LENGTH)
    count = int((last - first) * RATE / speed + 1e-9) + 1
    return first + np.arange(count) * speed / RATE, speed


class SnapshotPictures:
    """Takes pictures in a studio and writes them.

    Args:
        source: what is shown.
        studio: SnapshotStudio.
        configuration: RViz's, as of YAML, for a bare view.
        options: ``size``, ``output``, ``timeout`` of the command.
    """

    def __init__(
        self, source: SnapshotSource, studio, configuration: dict, options: argparse.Namespace
    ):
        self._source = source
        self._studio = studio
        self._configuration = configuration
        self._options = options
        self._progress = ProgressDisplay(sys.stderr)

    def take(self, times: Sequence[float], layout: str) -> None:
        """Pictures at some times [s], increasing, one each or all in one.

        Raises:
            ProgramError: a program that makes the pictures failed.
            OSError: a picture cannot be written.
        """
        if layout == OVERLAID:
            self._save(self._overlaid(times), times, layout)
        elif layout == SIDE_BY_SIDE:
            pictures, captions = [], []
            for time, picture in zip(times, self._pictures(times, self._without(*_SMALL))):
                pictures.append(picture)
                captions.append(self._caption(f"{time:g} s", _TIME_LETTERS, _ROW_LETTERS))
            row = [labelled(*each, clear_of=pictures) for each in zip(pictures, captions)]
            self._save(side_by_side(row), times, layout)
        else:
            configuration = self._without(DISTANCE_LABELS)
            for time, picture in zip(times, self._pictures(times, configuration)):
                caption = self._caption(f"{time:g} s", _LETTERS, _LETTERS)
                self._save(labelled(picture, caption, clear_of=[picture]), [time], layout)

    def film(self, path: Path, speed: Optional[float]) -> None:
        """A video of the whole run. Raises ProgramError, OSError."""
        times, speed = film_times(*self._source.time_range, speed)
        size = self._options.size
        configuration = self._without(DISTANCE_LABELS)
        print(f"{NAME}: filming at {speed:g} times real time", file=sys.stderr)
        pictures = self._studio.film(configuration, times, self._options.timeout)
        try:
            with video_file(path, size) as add:
                for number, (time, picture) in enumerate(zip(times, pictures), start=1):
                    add(labelled(picture, self._caption(f"{time:.1f} s", _LETTERS, _LETTERS)))
                    self._progress(number / len(times))
        finally:
            self._progress.close()
        print(path, flush=True)

    def _overlaid(self, times: Sequence[float]) -> np.ndarray:
        # Imported late: matplotlib.
        from matplotlib.colors import to_rgb

        from deformable_manipulation.plots.style import colour_of

        pictures, places, legend = [], [], []
        colors = [255.0 * np.array(to_rgb(colour_of(number))) for number in range(len(times))]
        height = round(_LETTERS * self._options.size[1])
        waiting = self._pictures(times, self._without(*_CROWDED, _TRAILS))
        for time, color, picture in zip(times, colors, waiting):
            pictures.append(picture)
            places.append(self._studio.leader)
            distance = self._studio.distance and f": distance {self._studio.distance}"
            legend.append((f"\u25a0 {time:g} s{distance}", height, color.astype(int)))
        print(f"{NAME}: taking pictures of the background and foreground", file=sys.stderr)
        self._studio.labels = time_labels(times, places)
        targets = [f"target_{agent.name}" for agent in self._source.scenario.agents]
        moving = (*_CROWDED, *_MOVING, *targets)
        base, empty, labels = (
            self._studio.take(
                self._without(*moving, *hidden),
                self._options.timeout,
                # There may be no obstacle, which would tell that RViz has drawn anything.
                shows=partial(is_alike, pictures[-1]),
                same_looks=_LOOKS,
            )
            for hidden in ((LABELS,), (LABELS, _TRAILS), (_TRAILS,))
        )
        picture = overlaid(base, empty, pictures, colors, labels)
        return labelled(picture, legend, clear_of=[picture])

    def _caption(self, time: str, time_letters: float, letters: float) -> List[tuple]:
        """The time and the distance of the newest picture; letters in shares of its height."""
        height = self._options.size[1]
        lines: List[tuple] = [(time, round(time_letters * height), INK)]
        if self._studio.distance:
            text = f"distance {self._studio.distance}"
            lines.append((text, round(letters * height), _DISTANCE_COLOR))
        return lines

    def _without(self, *namespaces: str) -> dict:
        return without(self._configuration, namespaces)

    def _pictures(self, times: Sequence[float], configuration: dict) -> Iterator[np.ndarray]:
        for time in times:
            print(f"{NAME}: running to {time:g} s", file=sys.stderr)
            try:
                self._studio.run.go_to(time, self._progress)
            finally:
                self._progress.close()
            print(f"{NAME}: taking the picture", file=sys.stderr)
            yield self._studio.take(configuration, self._options.timeout)

    def _save(self, picture: np.ndarray, times: Sequence[float], layout: str) -> None:
        scenario = self._source.scenario.name
        path = self._options.output / picture_name(scenario, times, layout)
        save_png(picture, path, "{} at {} s".format(scenario, ", ".join(f"{t:g}" for t in times)))
        print(path, flush=True)
