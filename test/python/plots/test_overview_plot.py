"""What the overview of a run shows."""

import numpy as np
import pytest
from matplotlib.figure import Figure
from synthetic_run import make_record, make_scenario

from deformable_manipulation.plots.overview_plot import plot_overview, snapshot_times
from deformable_manipulation.plots.snapshot_plot import SnapshotPlot, boundary_edges, widest_plane
from deformable_manipulation.recording import RunRecorder, read_run
from deformable_manipulation.recording.frame_reader import read_frames
from deformable_manipulation.recording.frames import Frames
from deformable_manipulation.scenario import load_scenario


@pytest.fixture
def run(tmp_path):
    scenario = make_scenario(tmp_path, assistants=2)
    recorder = RunRecorder(scenario, tmp_path / "trial")
    for cycle in range(200):
        recorder.record(make_record(scenario, cycle))
    recorder.finish(1.0, True)
    return read_run(tmp_path / "trial")


def lines_of(axis):
    return [line.get_xydata() for line in axis.get_lines()]


def test_the_object_is_drawn_at_the_times_asked_for(run):
    frames = read_frames(run)
    figure = plot_overview(run, frames, [0.5, 1.5])
    view = figure.axes[0]
    across, up = widest_plane(frames)
    for time in (0.5, 1.5):
        shape = frames.points[frames.at(time)][:, [across, up]]
        assert any(
            line.shape == shape.shape and np.allclose(line, shape) for line in lines_of(view)
        )
    assert [text.get_text() for text in view.get_legend().get_texts()] == ["0.5 s", "1.5 s"]


def test_every_assistant_has_its_error(run):
    panel = plot_overview(run, read_frames(run)).axes[2]
    for series in run.assistants:
        assert any(
            np.allclose(line[:, 1], series.error_norm)
            for line in lines_of(panel)
            if len(line) == len(series.time)
        )


def test_colours_are_of_times_alone(run):
    figure = plot_overview(run, read_frames(run), [0.5, 1.5])
    times = {line.get_color() for line in figure.axes[0].get_legend().get_lines()}
    series = {
        line.get_color()
        for panel in figure.axes[1:]
        for line in panel.get_lines()
        if len(line.get_xdata()) == len(run.time)
    }
    assert len(times) == 2 and series and not times & series


def test_the_lowest_distance_and_its_limit_are_told(run):
    texts = plot_overview(run, read_frames(run)).axes[1].get_legend().get_texts()
    lowest = 1e3 * run.distance.min()
    assert [text.get_text() for text in texts] == [
        f"distance (min {lowest:.3g} mm)",
        "limit 50 mm",
    ]


def test_telling_times_are_the_start_and_the_lowest_distance(run):
    times = snapshot_times(run)
    assert times == sorted(times) and times[0] == 0.0 and len(times) <= 4
    lowest = run.time[np.argmin(run.distance)]
    assert min(abs(time - lowest) for time in times) <= 0.05


def test_a_fabric_s_outline_is_what_belongs_to_one_triangle():
    square = np.array([[0, 1, 2], [0, 2, 3]])
    assert {tuple(edge) for edge in boundary_edges(square)} == {(0, 1), (1, 2), (2, 3), (0, 3)}


def test_a_planar_obstacle_is_seen_in_its_plane():
    scenario = load_scenario("rope_one_assistant")
    points = np.zeros((1, 29, 3))
    agents = np.array([[agent.start for agent in scenario.agents]])
    frames = Frames(scenario, np.zeros(1), points, agents)
    assert widest_plane(frames) == (1, 2)
    axes = Figure().subplots()
    SnapshotPlot(frames, axes).draw([0.0])
    (ground,) = axes.patches
    assert ground.get_path().vertices[:-1].shape == (86, 2)
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("y [m]", "z [m]")
