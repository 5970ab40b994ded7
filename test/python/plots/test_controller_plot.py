from pathlib import Path

import numpy as np
import pytest
from matplotlib.collections import PolyCollection
from matplotlib.colors import to_hex

from deformable_manipulation.control.status import Status
from deformable_manipulation.plots.controller_plot import plot_controller
from deformable_manipulation.plots.style import COLUMN_WIDTH, save_figure
from deformable_manipulation.recording import AssistantSeries, RunData

TIME = np.arange(100) / 10.0
OFFSET = 0.05


def make_run(distance=None, offset=OFFSET, **changes):
    time = changes.pop("time", TIME)
    distance = np.full(len(time), 0.1) if distance is None else distance
    velocity = np.zeros((len(time), 3))
    velocity[:, 1] = np.sin(time)
    values = {
        "error_norm": np.linspace(0.0, 0.3, len(time)),
        "h": {
            "collision": distance - OFFSET,
            "overstretch": np.full(len(time), 0.4),
            "proximity": np.full(len(time), 0.8),
        },
        "nominal_velocity": velocity,
        "command": 0.5 * velocity,
        "target": velocity,
        "status": np.full(len(time), Status.NOMINAL),
    }
    values.update(changes)
    series = AssistantSeries(agent="assistant_1", time=time, distance=distance, **values)
    return RunData("run", Path("run"), time, distance, offset, (series,))


def plot(run):
    return plot_controller(run, run.assistants[0])


def labels(axis):
    return axis.get_legend_handles_labels()[1]


def violation_marks(axis):
    return [line for line in axis.lines if line.get_marker() == "v"]


def shaded_intervals(axis, colour):
    """(start, end) of the rectangles of a colour."""
    intervals = []
    for collection in axis.collections:
        if isinstance(collection, PolyCollection) and to_hex(collection.get_facecolor()) == colour:
            for path in collection.get_paths():
                box = path.get_extents()
                intervals.append((box.x0, box.x1))
    return intervals


def figure_legend(figure):
    return [text.get_text() for text in figure.legends[0].get_texts()]


def test_panels_show_the_series_over_one_time_axis():
    run = make_run()
    series = run.assistants[0]
    figure = plot(run)
    distance, error, margin, velocity = figure.axes
    np.testing.assert_array_equal(distance.lines[0].get_xydata().T, [run.time, run.distance])
    np.testing.assert_array_equal(distance.lines[1].get_ydata(), [OFFSET, OFFSET])
    np.testing.assert_array_equal(error.lines[0].get_ydata(), series.error_norm)
    np.testing.assert_array_equal(margin.lines[0].get_ydata(), [0, 0])
    np.testing.assert_array_equal(margin.lines[1].get_ydata(), series.h["overstretch"])
    np.testing.assert_array_equal(margin.lines[2].get_ydata(), series.h["proximity"])
    np.testing.assert_array_equal(velocity.lines[0].get_ydata(), series.command[:, 1])
    np.testing.assert_array_equal(velocity.lines[1].get_ydata(), series.nominal_velocity[:, 1])
    assert [axis.get_xlim() for axis in figure.axes] == [(0.0, 10.0)] * 4
    assert velocity.get_xlabel() == "time [s]"
    assert all("[m" in axis.get_ylabel() for axis in figure.axes)
    assert figure.get_size_inches()[0] == COLUMN_WIDTH


def test_only_moving_components_of_the_velocity_are_shown():
    command = np.zeros((100, 3))
    command[:, 2] = 0.1
    figure = plot(make_run(command=command))
    names = [axis.get_ylabel() for axis in figure.axes[3:]]
    assert names == ["velocity y [m/s]", "velocity z [m/s]"]


def test_an_assistant_that_never_moves_shows_all_components():
    still = np.zeros((100, 3))
    assert len(plot(make_run(command=still, nominal_velocity=still)).axes) == 6


def test_violations_are_marked_at_their_worst():
    distance = np.full(100, 0.1)
    distance[40:45] = [0.049, 0.04, 0.031, 0.04, 0.049]
    overstretch = np.full(100, 0.4)
    overstretch[70] = -0.002
    figure = plot(make_run(distance, h={"overstretch": overstretch}))
    (mark,) = violation_marks(figure.axes[0])
    assert mark.get_xydata().tolist() == [[TIME[42], 0.031]]
    (mark,) = violation_marks(figure.axes[2])
    assert mark.get_xydata().tolist() == [[TIME[70], -0.002]]
    assert labels(figure.axes[0])[0] == "distance (min 31 mm)"
    assert labels(figure.axes[2])[0] == "overstretch (min -2 mm)"
    assert figure_legend(figure) == ["violation"]


def test_no_violation_no_mark():
    figure = plot(make_run(np.full(100, OFFSET)))
    assert not any(violation_marks(axis) for axis in figure.axes)
    assert figure_legend(figure) == []


def test_the_limit_is_told():
    assert labels(plot(make_run()).axes[0])[1] == "limit 50 mm"


def test_rounding_errors_look_like_zero():
    error = plot(make_run(error_norm=np.full(100, 1e-9))).axes[1]
    assert error.get_ylim() == (0.0, 0.01)


def test_far_distances_do_not_hide_near_ones():
    distance = np.linspace(0.04, 3.0, 100)
    axis = plot(make_run(distance)).axes[0]
    assert axis.get_ylim()[1] == pytest.approx(5 * OFFSET)
    assert axis.get_ylim()[0] < 0.04


def test_shading_follows_the_status():
    status = np.full(100, Status.NOMINAL)
    status[10:30] = Status.CONSTRAINED
    status[30] = Status.RELAXED
    status[31:40] = Status.CONSTRAINED
    status[98:] = Status.FAILED
    figure = plot(make_run(status=status))
    assert figure_legend(figure) == ["filter active", "constraints relaxed", "no solution"]
    for axis in figure.axes:
        for colour, expected in (
            ("#dcebf6", [(1.0, 3.0), (3.1, 4.0)]),
            ("#f3c27e", [(3.0, 3.1)]),
            ("#c9664b", [(9.8, 9.9)]),
        ):
            np.testing.assert_allclose(shaded_intervals(axis, colour), expected)


@pytest.mark.parametrize(
    "status, label",
    [
        (Status.WAITING, "stopped"),
        (Status.DISABLED, "stopped"),
        (Status.UNSAFE_FILTER_OFF, "filter off"),
    ],
)
def test_every_status_but_nominal_is_told(status, label):
    assert figure_legend(plot(make_run(status=np.full(100, status)))) == [label]


def test_without_obstacle(tmp_path):
    figure = plot(make_run(np.full(100, np.inf), offset=None))
    assert [text.get_text() for text in figure.axes[0].texts] == ["no obstacle"]
    save_figure(figure, tmp_path / "a.png")


def test_unknown_numbers_leave_gaps(tmp_path):
    run = make_run(
        distance=np.where(TIME < 2, np.nan, 0.04),
        error_norm=np.where(TIME < 2, np.nan, 0.1),
        h={"overstretch": np.full(100, np.nan), "proximity": np.where(TIME < 2, np.nan, 0.1)},
        nominal_velocity=np.full((100, 3), np.nan),
    )
    figure = plot(run)
    assert labels(figure.axes[2]) == ["proximity (min 100 mm)"]
    assert len(violation_marks(figure.axes[0])) == 1
    save_figure(figure, tmp_path / "a.png")


@pytest.mark.filterwarnings("error")
def test_a_run_of_one_cycle(tmp_path):
    save_figure(plot(make_run(time=np.array([3.0]))), tmp_path / "a.png")


@pytest.mark.parametrize(
    "ending, magic", [("png", b"\x89PNG"), ("pdf", b"%PDF"), ("svg", b"<?xml")]
)
def test_formats(tmp_path, ending, magic):
    path = tmp_path / f"figure.{ending}"
    save_figure(plot(make_run()), path)
    assert path.read_bytes().startswith(magic)


def test_pdf_fonts_are_of_a_type_that_publishers_accept(tmp_path):
    save_figure(plot(make_run()), tmp_path / "figure.pdf")
    assert b"/Type3" not in (tmp_path / "figure.pdf").read_bytes()


def test_a_barrier_of_any_name_has_its_margin():
    figure = plot(make_run(h={"workspace": np.full(100, 0.02)}))
    assert labels(figure.axes[2]) == ["workspace (min 20 mm)"]
