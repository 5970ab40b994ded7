"""A rope carried over a terrain, cycle by cycle with the same calculator."""

import numpy as np
import pytest
import shapely
from planar_reference import obstacle

from deformable_manipulation.distance.minimum_distance import MinimumDistance


def terrain():
    u = np.linspace(-3.0, 3.0, 84)
    surface = np.column_stack((u, 0.3 * np.sin(3.0 * u) + 0.1 * np.sin(11.0 * u)))
    return np.vstack((surface, [(3.0, -2.0), (-3.0, -2.0)]))


def carried_rope(cycle):
    """Copy 0 and six copies displaced by up to 0.1 m, (7, 29, 3), in the yz plane."""
    s = np.linspace(-1.0, 1.0, 29)
    height = 0.5 + 0.45 * np.sin(0.13 * cycle)
    rope = np.column_stack((0.0 * s, s + 2.5 * np.sin(0.05 * cycle), height + 0.3 * s**2))
    displacements = 0.1 * np.vstack((np.zeros((1, 3)), np.eye(3), -np.eye(3)))
    return rope + np.linspace(0.0, 1.0, 29)[:, None] * displacements[:, None]


def test_every_cycle_is_as_if_it_were_the_first():
    settings = [obstacle(terrain(), plane="yz")], 0.0035, 0.1
    calculator = MinimumDistance(*settings)
    polygon = shapely.Polygon(terrain())
    for cycle in range(150):
        points = carried_rope(cycle)
        result, fresh = calculator.compute(points), MinimumDistance(*settings).compute(points)
        assert result.minimum == pytest.approx(fresh.minimum, abs=1e-12)
        assert result.distance == pytest.approx(fresh.distance, abs=1e-9)
        assert (result.vertices == fresh.vertices).all()
        expected = polygon.distance(shapely.linestrings(points[..., 1:])) - 0.0035
        outside = expected > 0.0
        assert result.minimum[outside] == pytest.approx(expected[outside], abs=1e-12)
        assert (result.minimum[~outside] <= 0.0).all()
        assert result.minimum[1] == pytest.approx(result.minimum[0], abs=1e-12)  # along the normal


def test_the_rope_is_outside_in_some_cycles_and_inside_in_others():
    calculator = MinimumDistance([obstacle(terrain(), plane="yz")], 0.0035)
    minima = [calculator.compute(carried_rope(cycle)).minimum[0] for cycle in range(0, 150, 5)]
    assert min(minima) < -0.02 and max(minima) > 0.3
