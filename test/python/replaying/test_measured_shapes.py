"""The CSV format of recordings: what is written is read; every mistake is found."""

import numpy as np
import pytest

from deformable_manipulation.replaying.measured_shapes import (
    MeasuredShapes,
    MeasuredShapesError,
    read_measured_shapes,
    write_measured_shapes,
)

HEADER = "time,x@0,y@0,z@0,x@0.5,y@0.5,z@0.5\n"


def written(tmp_path, text):
    path = tmp_path / "shapes.csv"
    path.write_text(text)
    return path


def test_what_is_written_is_read(tmp_path):
    points = np.random.default_rng(1).random((4, 3, 3)).round(6)
    points[2, 1] = np.nan
    shapes = MeasuredShapes(np.array((0.0, 0.01, 0.02, 0.05)), np.array((0.0, 0.4, 1.1)), points)
    path = tmp_path / "shapes.csv"
    write_measured_shapes(path, shapes)
    found = read_measured_shapes(path)
    np.testing.assert_array_equal(found.time, shapes.time)
    np.testing.assert_array_equal(found.places, shapes.places)
    np.testing.assert_array_equal(found.points, points)


def test_missing_points_are_interpolated_over_time():
    points = np.zeros((3, 2, 3))
    points[2] = 2.0
    points[1, 1] = np.nan
    shapes = MeasuredShapes(np.array((0.0, 1.0, 4.0)), np.array((0.0, 1.0)), points)
    np.testing.assert_allclose(shapes.without_gaps()[1, 1], 0.5)
    points[:, 0] = np.nan
    with pytest.raises(MeasuredShapesError, match="the point at 0 m was never seen"):
        shapes.without_gaps()


@pytest.mark.parametrize(
    "text, mistake",
    [
        ("", "is empty"),
        ("\n", "line 1 is empty; it must name the columns"),
        ("t" + HEADER[4:] + "0,1,2,3,4,5,6\n" * 2, "must be time"),
        ("time,x@0,y@0,z@0\n", "two or more points"),
        (HEADER.replace("y@0.5", "y@0.6"), "columns 5 to 7"),
        (HEADER.replace("0.5", "0"), "the arc length 0 m of column 5"),
        (HEADER + "0,1,2,3,4,5,6\n", "at least two lines"),
        (HEADER + "0,1,2,3,4,5,6\n0,1,2,3,4,5,6\n", "line 3: the time 0 s is not after"),
        (HEADER + "0,1,2,3,4,5\n", "line 2 has 6 columns"),
        (HEADER + "0,1,2,3,4,5,six\n", "line 2, column 7: 'six' must be a number"),
        (HEADER + "0,1,2,3,4,5,inf\n", "line 2, column 7: 'inf'"),
        (HEADER + ",1,2,3,4,5,6\n", "line 2, column 1: '' must be a number"),
        (HEADER + "0,1,2,3,4,5,\n", "lacks one or two of its coordinates"),
    ],
)
def test_mistakes_are_named(tmp_path, text, mistake):
    with pytest.raises(MeasuredShapesError, match="shapes.csv: ") as caught:
        read_measured_shapes(written(tmp_path, text))
    assert mistake in str(caught.value)


def test_all_mistakes_are_listed_up_to_ten(tmp_path):
    rows = "".join(f"{i},a,2,3,4,5,6\n" for i in range(30))
    with pytest.raises(MeasuredShapesError) as caught:
        read_measured_shapes(written(tmp_path, HEADER + rows))
    lines = str(caught.value).splitlines()
    assert len(lines) == 11
    assert lines[-1].endswith("more")


def test_a_file_that_is_not_there_is_named(tmp_path):
    with pytest.raises(MeasuredShapesError, match="absent.csv"):
        read_measured_shapes(tmp_path / "absent.csv")
