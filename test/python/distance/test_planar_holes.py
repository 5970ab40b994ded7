"""Planar obstacles with holes and of several pieces, against Shapely."""

import numpy as np
import pytest
import shapely
from planar_reference import in_plane

from deformable_manipulation import _distance
from deformable_manipulation.distance.minimum_distance import MinimumDistance
from deformable_manipulation.distance.reference import ReferenceMinimumDistance
from deformable_manipulation.geometry.regions import polygon_region
from deformable_manipulation.scenario.spec import PolygonObstacle

YARD = (
    ((-3.0, -2.0), (3.0, -2.0), (3.0, 2.0), (-3.0, 2.0)),
    ((-2.0, -1.0), (2.0, -1.0), (2.0, 0.5), (0.0, 1.5), (-2.0, 0.5)),
)
ISLAND = ((-0.5, -0.5), (0.5, -0.5), (0.0, 0.5))
SHED = ((5.0, 0.0), (6.0, 0.0), (5.0, 1.0))
REGIONS = [YARD, (*YARD, ISLAND), (SHED, *YARD[::-1], ISLAND)]


def signed(rings, points):
    """Signed distances of points (K, 2)."""
    region = polygon_region(rings)
    unsigned = shapely.distance(region.boundary, shapely.points(points))
    return np.where(shapely.contains_xy(region, points), -unsigned, unsigned)


def calculator(rings):
    return MinimumDistance([PolygonObstacle("yard", rings, "xy")], 0.0, 0.1)


@pytest.mark.parametrize("rings", REGIONS)
@pytest.mark.parametrize("reverse", [False, True])
def test_points(rings, reverse):
    given = tuple(ring[::-1] for ring in rings) if reverse else rings
    distance = calculator(given)
    points = np.random.default_rng(1).uniform((-4.0, -3.0), (7.0, 3.0), (400, 2))
    expected = signed(rings, points)
    assert (expected < 0.0).any() and (expected > 0.0).any()
    copies = np.array([in_plane([point, point]) for point in points])
    assert distance.compute(copies).minimum == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("rings", REGIONS)
def test_polylines(rings):
    distance = calculator(rings)
    random = np.random.default_rng(2)
    for _ in range(40):
        line = random.uniform((-4.0, -3.0), (7.0, 3.0), (1, 2)) + np.cumsum(
            random.normal(0.0, 0.4, (6, 2)), axis=0
        )
        parts = np.linspace(0.0, 5.0, 4001)
        samples = np.column_stack([np.interp(parts, np.arange(6), line[:, k]) for k in (0, 1)])
        step = np.linalg.norm(np.diff(line, axis=0), axis=1).max() / 800.0
        found = distance.compute(in_plane(line)[None])
        least = signed(rings, samples).min()
        assert least - step <= found.minimum[0] <= least + 1e-12
        assert signed(rings, found.object_point[:, :2]) == pytest.approx(found.distance, abs=1e-9)


@pytest.mark.parametrize("rings", REGIONS)
def test_surfaces(rings):
    """Triangles, among them some that hold the whole hole or the whole obstacle."""
    random = np.random.default_rng(3)
    for size in (0.3, 2.0, 20.0):
        for _ in range(15):
            corners = random.uniform(-3.0, 3.0, (1, 2)) + random.normal(0.0, size, (3, 2))
            distance = MinimumDistance(
                [PolygonObstacle("yard", rings, "xy")], 0.0, 0.1, [[0, 1, 2]]
            )
            weights = random.dirichlet((1.0, 1.0, 1.0), 4000)
            least = signed(rings, weights @ corners).min()
            found = distance.compute(in_plane(corners)[None]).minimum[0]
            assert found <= least + 1e-12
            places = np.random.default_rng(4).uniform((-3.0, -2.0), (6.0, 2.0), (4000, 2))
            inside = shapely.contains_xy(shapely.Polygon(corners), places)
            assert found <= signed(rings, places[inside]).min(initial=np.inf) + 1e-12
            assert found >= least - 0.5 * size


def test_normals_point_into_the_hole():
    found = calculator(YARD).compute(in_plane([(-1.0, -0.9), (1.0, -0.9)])[None])
    assert found.minimum[0] == pytest.approx(0.1)
    assert found.normal[0] == pytest.approx([0.0, 1.0, 0.0])
    assert found.obstacle_point[0, 1] == pytest.approx(-1.0)


def test_the_reference_backend_agrees():
    obstacle = PolygonObstacle("yard", REGIONS[2], "yz", (0.2, 0.1, -0.3), (0.0, 0.6, 0.0, 0.8))
    line = np.random.default_rng(5).uniform(-3.0, 3.0, (1, 12, 3))
    ours = MinimumDistance([obstacle], 0.01, 0.1).compute(line)
    reference = ReferenceMinimumDistance([obstacle], 0.01, 0.1).compute(line)
    assert ours.minimum == pytest.approx(reference.minimum, abs=0.05)


def test_rings_that_meet_are_refused():
    with pytest.raises(ValueError, match="the polygon crosses or touches itself"):
        _distance.PlanarObstacle([YARD[0], ((-3.0, 0.0), (0.0, 0.5), (0.0, -0.5))], "xy")
    with pytest.raises(ValueError, match="ring 1: a polygon needs 3 distinct points"):
        _distance.PlanarObstacle([YARD[0], ((0.0, 0.0), (1.0, 0.0))], "xy")
