"""Files with grids of distances."""

import zipfile

import numpy as np
import pytest

from deformable_manipulation.geometry.field_files import FieldError, read_field

GRID = np.arange(24.0).reshape(2, 3, 4) * 0.01
CORRECT = {"distances": GRID, "origin": np.array((1.0, 2.0, 3.0)), "spacing": np.array(0.1)}


@pytest.fixture
def read(tmp_path):
    def read_arrays(is_free=True, **arrays):
        np.savez(tmp_path / "field.npz", **{**CORRECT, **arrays})
        return read_field(tmp_path / "field.npz", is_free)

    return read_arrays


def test_a_field(read):
    field = read()
    np.testing.assert_allclose(field.distances, GRID)
    assert field.distances.dtype == np.float32 and field.unknown == 0
    assert field.origin.tolist() == [1.0, 2.0, 3.0] and field.spacing.tolist() == [0.1] * 3
    assert read(spacing=np.array((0.1, 0.2, 0.3))).spacing.tolist() == [0.1, 0.2, 0.3]


@pytest.mark.parametrize("is_free, value", [(True, 0.22), (False, -0.1)])
def test_what_is_unknown_counts_as_the_scenario_says(is_free, value, read):
    grid = GRID.copy()
    grid[1, 2, 3] = np.nan
    field = read(is_free, distances=grid)
    assert field.unknown == 1 and field.distances[1, 2, 3] == pytest.approx(value)


@pytest.mark.parametrize(
    "arrays, told",
    [
        ({"distances": GRID[0]}, "size of distances is 3 x 4; it must"),
        ({"distances": GRID[:1]}, "each 2 or more"),
        ({"distances": np.full((2, 2, 2), "a")}, "distances holds no numbers"),
        ({"distances": np.full((2, 2, 2), np.nan)}, "none of its distances is a number"),
        ({"distances": np.full((2, 2, 2), np.inf)}, "at most 1e.06 m; those that are not known"),
        ({"origin": np.zeros(2)}, "origin must be three"),
        ({"origin": np.full(3, np.nan)}, "origin must be three"),
        ({"spacing": np.zeros(3)}, "spacing must be one number, or three"),
        ({"spacing": np.ones(2)}, "spacing must be one number, or three"),
        ({"spacing": np.array({}, dtype=object)}, "no archive .*broken"),
    ],
)
def test_arrays_that_are_wrong(arrays, told, read):
    with pytest.raises(FieldError, match="field.npz.*" + told):
        read(**arrays)


def test_arrays_that_are_missing(tmp_path):
    np.savez(tmp_path / "field.npz", distances=GRID)
    with pytest.raises(FieldError, match="has no array origin, spacing; the arrays of a field"):
        read_field(tmp_path / "field.npz", True)


def test_files_that_are_none(tmp_path):
    with pytest.raises(FieldError, match="cannot be read: No such file"):
        read_field(tmp_path / "field.npz", True)
    with pytest.raises(FieldError):
        read_field(tmp_path, True)
    np.save(tmp_path / "field.npy", GRID)
    with pytest.raises(FieldError, match="no archive"):
        read_field(tmp_path / "field.npy", True)
    with zipfile.ZipFile(tmp_path / "field.npz", "w") as archive:
        for key in CORRECT:
            archive.writestr(f"{key}.npy", b"hello")
    with pytest.raises(FieldError, match="distances holds no numbers"):
        read_field(tmp_path / "field.npz", True)
    np.savez(tmp_path / "field.npz", **CORRECT)
    data = (tmp_path / "field.npz").read_bytes()
    for end in range(0, len(data), 40):
        (tmp_path / "field.npz").write_bytes(data[:end])
        with pytest.raises(FieldError, match="no archive|broken"):
            read_field(tmp_path / "field.npz", True)
