"""Rings of polygons: reading and checking."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from deformable_manipulation.geometry.polygon_files import read_rings
from deformable_manipulation.geometry.polygons import PolygonError, check_ring

TRIANGLE = ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0))


def read_text(tmp_path, text):
    path = tmp_path / "ring.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode("utf-8"))
    (ring,) = read_rings(path)
    return ring


@pytest.mark.parametrize(
    "text",
    [
        "0,0\n1,0\n0,1\n",
        "y,z\n0,0\n1,0\n0,1",
        "# a comment\n\n  y , z # header\n0,0\n 1.0 ,\t0 # here\n\n0,1e0\n",
        "\ufeffy,z\r\n0,0\r\n1,0\r\n0,1\r\n",
        "0,0\n1,0\n0,1\n0,0\n",
        "0,0\n0,0\n1,0\n1,0\n1,0\n0,1\n",
    ],
)
def test_files_of_a_triangle(tmp_path, text):
    ring = read_text(tmp_path, text)
    assert sorted(ring) == sorted(TRIANGLE)
    assert len(ring) == 3


@pytest.mark.parametrize(
    "text, expected",
    [
        ("0,0\n1,0,5\n0,1\n", "line 2 has 3 columns, not 2"),
        ("0,0\n1\n0,1\n2\n", "line 2 has 1 columns"),
        ("0 0\n1 0\n0 1\n", "line 1 has 1 columns"),
        ("0,0\n1,zero\n0,1\n", "line 2: '1,zero' are not two numbers"),
        ("y,0\n1,0\n0,1\n", "line 1: 'y,0' are not two numbers"),
        ("y,z\ny,z\n0,0\n1,0\n0,1\n", "line 2: 'y,z' are not two numbers"),
        ("0,0\n1,nan\n0,1\n", "line 2: '1,nan' is not finite"),
        ("0,0\n1,\n0,1\n", "line 2: '1,' are not two numbers"),
        ("", "3 distinct points or more, not 0"),
        (b"0,0\n1,\xff\n", "not UTF-8"),
        ("a\n" * 20, "and 15 lines more"),
    ],
)
def test_files_that_are_refused(tmp_path, text, expected):
    with pytest.raises(PolygonError) as caught:
        read_text(tmp_path, text)
    assert expected in str(caught.value)
    assert "ring.csv" in str(caught.value)


@pytest.mark.parametrize("path", ["/dev/zero", "."])
def test_what_is_no_regular_file_is_refused(path):
    with pytest.raises(PolygonError, match=f"^{path} "):
        read_rings(path)


def test_every_wrong_line_is_told(tmp_path):
    with pytest.raises(PolygonError, match="line 2 .*line 4"):
        read_text(tmp_path, "0,0\n1\n0,1\nx,y\n")


def test_missing_file_and_directory(tmp_path):
    for path in (tmp_path / "absent.csv", tmp_path):
        with pytest.raises(PolygonError, match="cannot be read"):
            read_rings(path)


@pytest.mark.parametrize(
    "points, expected",
    [
        ([(0, 0), (1, 1)], "3 distinct points or more, not 2"),
        ([(0, 0), (1, 1), (0, 0), (1, 1)], "not 2"),
        ([(0, 0), (1, 1), (2, 2), (5, 5)], "no area"),
        ([(0, 0), (1e-9, 0), (0, 1e-9)], "no area"),
        ([(0, 0), (1, 1), (1, 0), (0, 1)], r"crosses or touches itself at \(0.5, 0.5\)"),
        ([(0, 0), (2, 0), (2, 2), (1, 0), (0, 2)], r"crosses or touches itself at \(1, 0\)"),
        ([(0, 0), (1, 0), (1, 1), (1, 3), (1, 1), (0, 1)], "crosses or touches itself"),
        ([(0, 0), (1, math.nan), (0, 1)], r"point 1 is \(1, nan\)"),
        ([(0, 0), (1, 0), (0, -math.inf)], "point 2"),
        ([(0, 0), (1e7, 0), (0, 1)], "at most 1e"),
    ],
)
def test_rings_that_are_refused(points, expected):
    with pytest.raises(PolygonError, match=expected):
        check_ring(points)


def test_both_orientations_are_kept_as_given():
    assert check_ring(TRIANGLE) == TRIANGLE
    assert check_ring(TRIANGLE[::-1]) == TRIANGLE[::-1]


def test_rings_that_are_not_convex():
    ring = ((0, 0), (4, 0), (4, 3), (2, 1), (0, 3))
    assert check_ring(ring) == ring


@given(st.lists(st.tuples(*[st.floats(-1e3, 1e3) | st.integers(-3, 3)] * 2), max_size=8))
def test_a_checked_ring_stays_as_it_is(points):
    try:
        ring = check_ring(points)
    except PolygonError:
        return
    assert check_ring(ring) == ring
    assert set(ring) <= {(float(a), float(b)) for a, b in points}
