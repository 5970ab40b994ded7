"""The result of a distance computation as Python holds it, made of arrays."""

import numpy as np
import pytest
from mesh_reference import FIELDS, changed, fields_of

from deformable_manipulation.distance.features import Distances

ARRAYS = {
    "minimum": np.array([0.2, 0.3]),
    "offsets": np.array([0, 2, 3]),
    "distance": np.array([0.2, 0.25, 0.3]),
    "obstacle": np.array([0, 1, 0]),
    "object_point": np.arange(9.0).reshape(3, 3),
    "obstacle_point": 10.0 + np.arange(9.0).reshape(3, 3),
    "normal": np.eye(3),
    "vertices": np.arange(9).reshape(3, 3),
    "weights": np.full((3, 3), 1.0 / 3.0),
    "obstacle_velocity": 20.0 + np.arange(9.0).reshape(3, 3),
    "identity": np.array([7, -1, 2**40]),
}


def test_arrays_come_back_as_they_were_given():
    distances = Distances(**ARRAYS, names=["ground", "cube"])
    for name, array in fields_of(distances).items():
        np.testing.assert_array_equal(array, ARRAYS[name], err_msg=name)
    assert distances.names == ("ground", "cube")
    assert [distances.of_copy(copy) for copy in (0, 1)] == [slice(0, 2), slice(2, 3)]
    with pytest.raises(IndexError, match="copies 0 to 1"):
        distances.of_copy(2)


@pytest.mark.parametrize("name", FIELDS)
def test_another_shape_is_refused_by_name(name):
    if name == "minimum":
        pytest.skip("it tells how many copies there are; offsets are refused then")
    with pytest.raises(ValueError, match=f"^{name} has shape" if name != "distance" else "shape"):
        Distances(**{**ARRAYS, name: ARRAYS[name][:-1]})


@pytest.mark.parametrize("name", ["offsets", "obstacle", "vertices", "identity"])
def test_indices_are_whole_numbers(name):
    with pytest.raises(ValueError, match=f"{name} is an array of float64"):
        Distances(**{**ARRAYS, name: ARRAYS[name].astype(float)})


def test_without_identities_there_are_none():
    assert changed(Distances(**ARRAYS), identity=None).identity.tolist() == [-1, -1, -1]


def test_unknown_distances_have_no_features():
    unknown = Distances.unknown(2, ["ground"])
    assert np.isnan(unknown.minimum).all() and len(unknown.distance) == 0
    assert unknown.offsets.tolist() == [0, 0, 0] and unknown.names == ("ground",)
