"""Files of points."""

import struct

import numpy as np
import pytest

from deformable_manipulation.cloud_formats.lzf import decompressed
from deformable_manipulation.geometry import cloud_files
from deformable_manipulation.geometry.cloud_files import CloudError, read_cloud
from deformable_manipulation.mesh_formats.faces import FormatError

POINTS = np.array([(0.0, 1.5, -2.0), (3.25, 0.5, 1e-3), (-7.0, 8.0, 9.0)], dtype=np.float32)
# x, y and z not first and not side by side, with a field of several numbers.
FIELDS = "FIELDS intensity x descriptor y z\nSIZE 1 4 2 4 4\nTYPE U F I F F\nCOUNT 1 1 3 1 1\n"
RECORD = np.dtype([("i", "u1"), ("x", "<f4"), ("d", "<i2", 3), ("y", "<f4"), ("z", "<f4")])


def header(form, points=3, fields=FIELDS):
    text = "# .PCD v0.7\nVERSION 0.7\n{}WIDTH {}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\n"
    return (text.format(fields, points) + f"POINTS {points}\nDATA {form}\n").encode()


def records(points=POINTS):
    array = np.zeros(len(points), RECORD)
    array["x"], array["y"], array["z"] = points.T
    array["i"], array["d"] = 7, 1
    return array


def literal_lzf(data):
    """LZF in which nothing is compressed."""
    pieces = [data[i : i + 32] for i in range(0, len(data), 32)]
    return b"".join(bytes([len(piece) - 1]) + piece for piece in pieces)


def compressed(points=POINTS):
    array = records(points)
    columns = b"".join(np.ascontiguousarray(array[name]).tobytes() for name in RECORD.names)
    packed = literal_lzf(columns)
    return struct.pack("<II", len(packed), len(columns)) + packed


def ascii_rows(points=POINTS):
    return "".join("7 {} 1 1 1 {} {}\n".format(*point) for point in points).encode()


PCD = {
    "ascii": header("ascii") + ascii_rows(),
    "binary": header("binary") + records().tobytes(),
    "binary_compressed": header("binary_compressed") + compressed(),
}


@pytest.fixture
def read(tmp_path):
    def read_bytes(data, name="points.pcd", **more):
        path = tmp_path / name
        path.write_bytes(data if isinstance(data, bytes) else data.encode())
        return read_cloud(path, **more)

    return read_bytes


@pytest.mark.parametrize("form", PCD)
def test_pcd(form, read):
    np.testing.assert_array_equal(read(PCD[form]).astype(np.float32), POINTS)


@pytest.mark.parametrize("form", PCD)
def test_every_pcd_that_is_cut_off_is_told(form, read):
    """Or has a shorter last number, as text may."""
    for end in range(0, len(PCD[form]) - 1, 5):
        if form == "ascii" and end > len(PCD[form]) - 4:
            continue
        with pytest.raises(CloudError, match="points.pcd"):
            read(PCD[form][:end])


@pytest.mark.parametrize(
    "fields, told",
    [
        ("FIELDS a x\nSIZE 4 4\nTYPE F F\n", "it has no field y, z"),
        ("FIELDS x y z\nSIZE 4 4\nTYPE F F F\n", "the number of FIELDS, SIZE"),
        ("FIELDS x y z\nSIZE 3 4 4\nTYPE F F F\n", "its header cannot be understood|broken"),
        ("FIELDS x y z\nSIZE 4 4 4\nTYPE Q F F\n", "its header cannot be understood: .*Q"),
        ("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 0\n", "COUNT"),
        ("SIZE 4 4 4\nTYPE F F F\n", "COLUMNS"),
    ],
)
def test_headers_that_are_wrong(fields, told, read):
    with pytest.raises(CloudError, match=told):
        read(header("ascii", 0, fields))


def test_a_pcd_of_more_points_than_there_is_memory_for_is_not_tried(read):
    with pytest.raises(CloudError, match="ends after 0 of the 10{15} points"):
        read(header("binary", 10**15))


def test_lines_of_a_pcd_that_are_wrong_are_told(read):
    with pytest.raises(CloudError, match="line 13: 'a few words' are not 7 numbers"):
        read(header("ascii", 2) + ascii_rows(POINTS[:1]) + b"a few words\n")


def test_doubles_keep_their_precision(read):
    fields = "FIELDS x y z\nSIZE 8 8 8\nTYPE F F F\n"
    points = np.array([(1.0 / 3.0, 1e5 + 1e-9, 0.1)])
    assert (read(header("binary", 1, fields) + points.tobytes()) == points).all()


def test_lzf_with_repetitions():
    packed = bytes([1]) + b"ab" + bytes([(4 << 5), 1]) + bytes([(7 << 5), 3, 0])
    assert decompressed(packed, 2 + 6 + 12) == b"ab" + b"ababab" + b"b" * 12
    for wrong in (packed[:-1], bytes([(1 << 5), 5]), packed + packed):
        with pytest.raises(FormatError, match="broken"):
            decompressed(wrong, 20)


def test_ply(read):
    lines = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    lines += "property float z\nproperty uchar red\nend_header\n"
    rows = "".join("{} {} {} 9\n".format(*point) for point in POINTS)
    np.testing.assert_allclose(read(lines + rows, "points.ply"), POINTS)
    with pytest.raises(CloudError, match="cut off"):
        read(lines + rows[: len(rows) // 2], "points.ply")


@pytest.mark.parametrize(
    "text",
    [
        "0 1.5 -2\n3.25 0.5 1e-3\n-7 8 9\n",
        "x,y,z,intensity\r\n0,1.5,-2,5\r\n3.25,0.5,1e-3,5\r\n-7,8,9,5\r\n",
        "# a scan\n\n0;1.5;-2\n3.25;0.5;1e-3\n  -7;8;9  # last",
    ],
)
def test_text(text, read):
    np.testing.assert_allclose(read(text, "points.xyz"), POINTS, rtol=1e-6)


@pytest.mark.parametrize(
    "text, told",
    [
        ("1 2\n3 4\n", "fewer than three numbers"),
        ("1 2 3\n4 five 6\n", "line 2: '4 five 6' are not 3 numbers"),
        ("x y z\n1 2 3\n4 5\n", "line 3: '4 5' are not 3 numbers"),
        ("# nothing\n", "no point in it"),
    ],
)
def test_text_that_is_wrong(text, told, read):
    with pytest.raises(CloudError, match=told):
        read(text, "points.xyz")


def npy(tmp_path, array):
    np.save(tmp_path / "points.npy", array)
    return tmp_path / "points.npy"


@pytest.mark.parametrize("shape", [(3, 3), (1, 3, 3)])
def test_npy(shape, tmp_path):
    np.testing.assert_array_equal(read_cloud(npy(tmp_path, POINTS.reshape(shape))), POINTS)
    wide = np.concatenate((POINTS, POINTS), axis=1)
    assert (read_cloud(npy(tmp_path, wide)) == POINTS).all()


@pytest.mark.parametrize(
    "array, told",
    [
        (np.zeros(3), "its size is 3; it must be N x 3"),
        (np.zeros((3, 2)), "must be N x 3"),
        (np.array([["a", "b", "c"]]), "no array of numbers"),
        (np.zeros((0, 3)), "there is no point in it$"),
        (np.full((1_000_000, 3), np.nan), "only 1000000 that are not finite"),
        (np.array([(0.0, 2e6, 0.0)]), "a point is at .0, 2e.06, 0."),
    ],
)
def test_npy_that_is_wrong(array, told, tmp_path):
    with pytest.raises(CloudError, match=told):
        read_cloud(npy(tmp_path, array))


def test_pickles_are_not_read(tmp_path):
    with pytest.raises(CloudError, match="no array of numbers, or it is broken$"):
        read_cloud(npy(tmp_path, np.array([{}], dtype=object)))


def test_points_that_are_not_finite_are_left_out(tmp_path):
    points = np.concatenate((POINTS, np.full((2, 3), np.nan), [(np.inf, 0.0, 0.0)]))
    np.testing.assert_array_equal(read_cloud(npy(tmp_path, points)), POINTS)


def test_the_origin_is_taken_off_in_full_precision(tmp_path):
    far = POINTS.astype(float) + (691000.0, 5334000.0, 0.0)
    moved = read_cloud(npy(tmp_path, far), (691000.0, 5334000.0, 0.0))
    np.testing.assert_allclose(moved, POINTS, atol=2e-9)


def test_files_that_are_none(tmp_path, monkeypatch):
    with pytest.raises(CloudError, match="nowhere.pcd"):
        read_cloud(tmp_path / "nowhere.pcd")
    with pytest.raises(CloudError, match="not a regular file|is a directory|directory"):
        read_cloud(tmp_path)
    (tmp_path / "empty.pcd").touch()
    with pytest.raises(CloudError, match="is empty"):
        read_cloud(tmp_path / "empty.pcd")
    (tmp_path / "scan.las").write_text("1 2 3")
    with pytest.raises(CloudError, match="'las' is no format.*PCD, PLY, XYZ"):
        read_cloud(tmp_path / "scan.las")
    monkeypatch.setattr(cloud_files, "LARGEST_FILE", 10)
    (tmp_path / "large.xyz").write_text("1 2 3\n" * 10)
    with pytest.raises(CloudError, match="more than 10 bytes"):
        read_cloud(tmp_path / "large.xyz")
