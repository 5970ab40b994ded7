import numpy as np
import pytest

from deformable_manipulation import _distance, _pbd

LINE = np.linspace([0.0, 0.0, 1.0], [0.0, 1.0, 1.0], 5)[None]


@pytest.fixture
def distance():
    wedge = _distance.PlanarObstacle([[-1, 0], [1, 0], [0, -1]])
    return _distance.MinimumDistance([wedge], margin=0.1, band=0.1)


def test_no_obstacle_in_place_of_one():
    with pytest.raises(ValueError, match=r"obstacles\[0\] is None"):
        _distance.MinimumDistance([None], 0.1, band=0.1)


@pytest.mark.parametrize(
    "triangles, text",
    [
        (np.zeros((0, 3), int), "triangles >= 1"),
        ([[0, 1, 2.5]], "whole numbers"),
        ([[0, 1, np.nan]], "whole numbers"),
        ("abc", "whole numbers"),
        ([[0, 1, 2**40]], "refers to point 1099511627776"),
        ([[0, 1, -1]], "refers to point -1"),
    ],
)
def test_triangles_that_are_none(distance, triangles, text):
    with pytest.raises(ValueError, match=text):
        distance.compute(LINE, triangles)


@pytest.mark.parametrize("factor", [1e300, np.nan, np.inf])
def test_points_out_of_range(distance, factor):
    with pytest.raises(ValueError, match="not finite, or beyond 1e6 m"):
        distance.compute(LINE * factor)


@pytest.mark.parametrize(
    "settings, text",
    [
        ({"tolerance": np.nan}, "tolerance is nan"),
        ({"tolerance": np.inf}, "tolerance is inf"),
        ({"tolerance": 0.0}, "tolerance is 0"),
        ({"iterations": 0}, "iterations is 0"),
        ({"iterations": 10**9}, "iterations is 1000000000"),
    ],
)
def test_settings_of_an_equilibrium(settings, text):
    rod = _pbd.Rod(
        length=1.0,
        radius=0.005,
        density=1000.0,
        segments=10,
        young_modulus=3e7,
        torsion_modulus=1e7,
        stretch="zero",
        damping=10.0,
        solver="direct",
        gravity=(0.0, 0.0, -9.81),
    )
    with pytest.raises(ValueError, match=text):
        _pbd.RodEquilibrium().update(rod, **settings)
