"""Overlaid snapshots of a run, seen along one axis: the paper's figures of the scenarios."""

from typing import Optional, Sequence, Tuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import to_rgb
from matplotlib.patches import PathPatch
from matplotlib.path import Path

from deformable_manipulation.obstacles.drawings import Dots
from deformable_manipulation.obstacles.spec import placed
from deformable_manipulation.plots.style import colour_of
from deformable_manipulation.recording.frames import Frames
from deformable_manipulation.recording.timeseries import AXES

GROUND, GROUND_EDGE = "#D9D9D9", "#808080"
_PALENESS = 0.35  # of moving obstacles, beside the object's colour
_MARGIN = 0.25  # m around the object's and the agents' ways


def widest_plane(frames: Frames) -> Tuple[int, int]:
    """The two axes, (across, up), in which the most can be seen.

    Up is z unless nothing moves or reaches along it; across is the wider one of the others.
    """
    planes = [obstacle.plane for obstacle in frames.scenario.obstacles if obstacle.plane]
    if planes:
        return AXES.index(planes[0][0]), AXES.index(planes[0][1])
    ways = np.ptp(frames.agents, axis=0).max(axis=0)
    across = 0 if ways[0] > ways[1] else 1
    return across, 2


class SnapshotPlot:
    """Draws frames of a run into axes.

    Args:
        frames: :class:`~.recording.frames.Frames`.
        axes: of matplotlib.
        plane: the two coordinates that are seen, (across, up).
    """

    def __init__(self, frames: Frames, axes: Axes, plane: Optional[Tuple[int, int]] = None):
        self._frames = frames
        self._axes = axes
        self._plane = list(plane or widest_plane(frames))

    def draw(self, times: Sequence[float]) -> None:
        """Obstacles, ways, and the object at some times [s], each in a colour of its own.

        Obstacles that move are drawn at each of these times, in a pale tone of its colour.
        """
        for obstacle in self._frames.scenario.obstacles:
            if obstacle.motion is None:
                self._draw_obstacle(obstacle, GROUND)
        for index in range(self._frames.agents.shape[1]):
            way = self._frames.agents[:, index, self._plane]
            self._axes.plot(*way.T, linestyle=":", linewidth=0.6, color="#606060", zorder=2)
        for number, time in enumerate(times):
            frame, colour = self._frames.at(time), colour_of(number)
            for obstacle in self._frames.obstacles_at(frame):
                if obstacle.motion is not None:
                    self._draw_obstacle(obstacle, _pale(colour))
            self._draw_frame(frame, colour)
        across, up = (AXES[axis] for axis in self._plane)
        self._axes.set_xlabel(f"{across} [m]")
        self._axes.set_ylabel(f"{up} [m]")
        self._axes.set_aspect("equal")
        low, high = self._limits(times)
        self._axes.set_xlim(low[0], high[0])
        self._axes.set_ylim(low[1], high[1])

    def height_per_width(self, times: Sequence[float]) -> float:
        """The proportion of what is seen when drawn at these times."""
        low, high = self._limits(times)
        return (high[1] - low[1]) / (high[0] - low[0])

    def _draw_frame(self, frame: int, colour: str) -> None:
        points = self._frames.points[frame][:, self._plane]
        faces = self._frames.faces
        if faces is None:
            self._axes.plot(*points.T, color=colour, linewidth=1.4, zorder=4)
        else:
            self._axes.add_collection(
                PolyCollection(points[faces], facecolors=colour, edgecolors="none", alpha=0.12)
            )
            self._axes.add_collection(
                LineCollection(
                    points[boundary_edges(faces)],
                    colors=colour,
                    linewidths=1.2,
                    zorder=4,
                )
            )
        self._draw_agents(frame, colour)

    def _draw_agents(self, frame: int, colour: str) -> None:
        """The leader as a square, the assistants as discs, their places as circles with arrows."""
        scenario, agents = self._frames.scenario, self._frames.agents[frame]
        leader = scenario.leader_index
        starts = np.array([agent.start for agent in scenario.agents])
        style = {"color": colour, "markersize": 4, "markeredgecolor": "black", "zorder": 6}
        self._axes.plot(*agents[leader, self._plane], marker="s", **style)
        for index in scenario.assistants:
            here = agents[index, self._plane]
            place = (agents[leader] + starts[index] - starts[leader])[self._plane]
            self._axes.plot(*here, marker="o", **style)
            if np.linalg.norm(here - place) > 0.02:
                self._axes.plot(*place, marker="o", **{**style, "color": "white"})
                self._axes.annotate(
                    "", here, place, arrowprops={"arrowstyle": "->", "color": colour}, zorder=5
                )

    def _draw_obstacle(self, obstacle, colour) -> None:
        if obstacle.plane:
            self._draw_region(obstacle, colour)
            return
        drawing = obstacle.drawing()
        if isinstance(drawing, Dots):
            places = placed(obstacle, drawing.places)[:, self._plane]
            self._axes.plot(*places.T, ",", color=colour, rasterized=True)
            return
        corners = placed(obstacle, drawing.triangles)[..., self._plane]
        self._axes.add_collection(PolyCollection(corners, facecolor=colour, edgecolor="none"))

    def _draw_region(self, obstacle, colour) -> None:
        """A polygon itself, rather than the piece of it that is drawn in space."""
        codes, corners = [], []
        for ring in obstacle.rings:
            points = placed(obstacle, obstacle.embedded(np.array(ring)))[:, self._plane]
            corners += [points, points[:1]]
            codes += [Path.MOVETO, *[Path.LINETO] * (len(ring) - 1), Path.CLOSEPOLY]
        path = Path(np.concatenate(corners), codes)
        self._axes.add_patch(PathPatch(path, facecolor=colour, edgecolor=GROUND_EDGE))

    def _limits(self, times: Sequence[float]) -> Tuple[np.ndarray, np.ndarray]:
        """Lower and upper limits (2,) [m] of the view."""
        shown = [self._frames.agents.reshape(-1, 3)[:, self._plane]]
        shown += [self._frames.points[self._frames.at(time)][:, self._plane] for time in times]
        shown = np.concatenate(shown)
        low, high = shown.min(axis=0) - _MARGIN, shown.max(axis=0) + _MARGIN
        lowest = self._frames.points[:, :, self._plane[1]].min()
        return np.array([low[0], min(low[1], lowest - 2.0 * _MARGIN)]), high


def _pale(colour: str) -> Tuple[float, ...]:
    """A colour for the ground behind lines of this one."""
    return tuple(1.0 - _PALENESS * (1.0 - part) for part in to_rgb(colour))


def boundary_edges(faces: np.ndarray) -> np.ndarray:
    """Edges (E, 2) of the triangles (T, 3) that belong to one of them only."""
    edges = np.sort(np.concatenate((faces[:, :2], faces[:, 1:], faces[:, ::2])), axis=1)
    unique, counts = np.unique(edges, axis=0, return_counts=True)
    return unique[counts == 1]
