"""Points as obstacles: against each point with each element."""

import cloud_reference as reference
import mesh_reference
import numpy as np
import pytest

from deformable_manipulation import _distance

RADIUS, MARGIN, BAND = 0.01, 0.003, 0.2  # m
SAME = 1e-9  # m, beside a distance, and the precision of the kept points


def precision(points):
    return SAME + 1e-7 * np.ptp(points, axis=0).max(initial=0.0)


def scattered(rng, count):
    return rng.normal(size=(count, 3))


def surface(rng, count):
    """As of a depth camera: a noisy surface seen from one side."""
    x, y = rng.uniform(-1.0, 1.0, (2, count))
    return np.column_stack((x, y, 0.2 * np.sin(4.0 * x) + 0.002 * rng.normal(size=count)))


def grid(rng, count):
    """As of a map: many points are equally far from anything level."""
    side = max(int(count ** (1.0 / 3.0)), 1)
    line = np.linspace(-0.5, 0.5, side)
    return np.stack(np.meshgrid(line, line, line), axis=-1).reshape(-1, 3)


def clusters(rng, count):
    """Crowded places far apart, which a grid of one size does not divide."""
    places = np.array([(0.0, 0.0, 0.0), (900.0, 0.0, 0.0), (0.0, -3e-3, 0.0)])
    return places[rng.integers(3, size=count)] + 1e-4 * rng.normal(size=(count, 3))


def same_place(rng, count):
    return np.tile((0.1, 0.2, 0.3), (count, 1))


def on_a_line(rng, count):
    return rng.uniform(-1.0, 1.0, (count, 1)) * (1.0, 0.5, -0.2)


SETS = pytest.mark.parametrize(
    "points_of", [scattered, surface, grid, clusters, same_place, on_a_line]
)
COUNTS = pytest.mark.parametrize("count", [1, 2, 7, 8, 9, 33, 1500])


def calculator(points, radius=RADIUS):
    obstacle = _distance.CloudObstacle(_distance.PointCloud(points), radius)
    return _distance.MinimumDistance([obstacle], MARGIN, BAND)


def objects(rng, is_surface):
    """An object in several positions, near and far, and moving a little."""
    for size in (0.02, 0.5, 2.0):
        middle = rng.normal(size=3) * rng.choice((0.1, 1.0, 10.0))
        points, triangles = mesh_reference.sheet(rng, cells=4, size=size, middle=middle)
        for _ in range(3):
            yield points, triangles if is_surface else None
            points = points + 0.01 * rng.normal(size=3) + 0.003 * rng.normal(size=points.shape)


@SETS
@COUNTS
@pytest.mark.parametrize("is_surface", [False, True])
def test_minima_and_features(points_of, count, is_surface):
    rng = np.random.default_rng(count)
    points = points_of(rng, count)
    minimum, same = calculator(points), precision(points)
    for geometry, triangles in objects(rng, is_surface):
        least = reference.element_distances(points, geometry, triangles).min(axis=1)
        least -= RADIUS + MARGIN
        found = minimum.compute(np.stack((geometry, geometry + 0.05)), triangles)
        assert found.minimum[0] == pytest.approx(least.min(), abs=same)
        own = found.of_copy(0)
        near = np.sort(least)[: own.stop]
        assert found.distance[own] == pytest.approx(near, abs=same)
        assert near[-1] <= least.min() + BAND + same
        assert np.sort(least)[own.stop :].min(initial=np.inf) >= least.min() + BAND - same
        moved = reference.element_distances(points, geometry + 0.05, triangles).min()
        assert found.minimum[1] == pytest.approx(moved - RADIUS - MARGIN, abs=same)
        _check_points(found, own, points, geometry)


def _check_points(found, rows, points, geometry):
    """Object points lie on the object, obstacle points on the balls, a distance apart."""
    places = np.einsum("mk,mki->mi", found.weights[rows], geometry[found.vertices[rows]])
    assert places == pytest.approx(found.object_point[rows], abs=1e-12)
    arm = found.object_point[rows] - found.obstacle_point[rows]
    along = (found.distance[rows] + MARGIN)[:, None] * found.normal[rows]
    assert arm == pytest.approx(along, abs=SAME)
    centres = found.obstacle_point[rows] - RADIUS * found.normal[rows]
    nearest = np.linalg.norm(centres[:, None] - points, axis=2).min(axis=1)
    assert nearest == pytest.approx(0.0, abs=precision(points))


def test_what_is_found_does_not_depend_on_calls_before():
    rng = np.random.default_rng(1)
    points = surface(rng, 3000)
    minimum = calculator(points)
    line = np.linspace((-1.0, 0.1, 0.5), (1.0, -0.1, 0.4), 30)
    for step in range(40):
        line = line + 0.02 * rng.normal(size=3) * (step % 10 > 0) + 0.4 * (step % 10 == 0)
        line[:, 2] = np.clip(line[:, 2], -0.3, 0.6)
        found = mesh_reference.fields_of(minimum.compute(line[None]))
        fresh = mesh_reference.fields_of(calculator(points).compute(line[None]))
        assert all((found[name] == fresh[name]).all() for name in found)


@pytest.mark.parametrize("tremble", [0.0, 2e-5, 1e-3])
@pytest.mark.parametrize("height", [0.5, 2.0])
@pytest.mark.parametrize("is_surface", [False, True])
def test_nor_does_what_is_found_of_an_object_that_moves_slowly(is_surface, height, tremble):
    rng = np.random.default_rng(2)
    x, y = rng.uniform(-1.0, 1.0, (2, 20_000))
    hill = 0.3 * np.exp(-4.0 * (x**2 + y**2))  # most points stay below those that are nearest
    cloud = np.column_stack((x, y, hill + 0.0005 * rng.normal(size=len(x))))
    minimum = calculator(cloud)
    points, triangles = mesh_reference.sheet(rng, cells=6, size=0.8, middle=(0.0, 0.0, height))
    for step in range(60):
        points = points + (0.0006, 0.0008, 0.002 * np.cos(0.3 * step))
        points = points + tremble * rng.normal(size=points.shape)
        arguments = points[None], triangles if is_surface else None
        found = mesh_reference.fields_of(minimum.compute(*arguments))
        fresh = mesh_reference.fields_of(calculator(cloud).compute(*arguments))
        assert len(found["distance"]) >= 5
        assert all((found[name] == fresh[name]).all() for name in found)


def test_an_object_through_a_point_is_as_deep_as_the_radius():
    line = np.array([(-1.0, 0.0, 0.0), (1.0, 0.0, 0.0)])
    found = calculator(np.zeros((1, 3))).compute(line[None])
    assert found.minimum[0] == pytest.approx(-RADIUS - MARGIN)
    assert np.linalg.norm(found.normal[0]) == pytest.approx(1.0)


def test_near_a_wall_each_element_has_one_feature():
    rng = np.random.default_rng(2)
    wall = np.column_stack((rng.uniform(-1.0, 1.0, (100_000, 2)), np.zeros(100_000)))
    line = np.linspace((-0.9, 0.0, 0.05), (0.9, 0.0, 0.05), 46)
    found = calculator(wall).compute(line[None])
    assert len(found.distance) == 45 and len(set(found.identity)) == 45


def test_a_moved_cloud():
    rng = np.random.default_rng(3)
    points, line = scattered(rng, 200), rng.normal(size=(6, 3))
    obstacle = _distance.CloudObstacle(_distance.PointCloud(points), RADIUS)
    angular, shift = np.array((0.1, 0.2, -0.4)), np.array((5.0, -2.0, 1.0))
    obstacle.set_pose(shift, (0.0, 0.0, 0.6, 0.8), (1.0, 0.0, 0.0), angular)
    found = _distance.MinimumDistance([obstacle], MARGIN, BAND).compute(line[None])
    turn = np.array([(0.28, -0.96, 0.0), (0.96, 0.28, 0.0), (0.0, 0.0, 1.0)])
    expected = calculator(points @ turn.T + shift).compute(line[None])
    assert found.distance == pytest.approx(expected.distance, abs=1e-6)
    velocity = (1.0, 0.0, 0.0) + np.cross(angular, found.obstacle_point - shift)
    assert found.obstacle_velocity == pytest.approx(velocity, abs=1e-12)


def test_several_clouds_are_as_one_of_all_points():
    rng = np.random.default_rng(4)
    line = np.linspace((-1.0, 0.0, 0.3), (1.0, 0.0, 0.3), 20)
    parts = [scattered(rng, count) for count in (500, 1, 0, 300)]
    clouds = [_distance.PointCloud(part) for part in parts]
    minimum = _distance.MinimumDistance([_distance.CloudObstacle(clouds, RADIUS)], MARGIN, BAND)
    one = calculator(np.concatenate(parts))
    for step in range(5):
        state = (line + (0.0, 0.0, 0.1 * step))[None]
        found = mesh_reference.fields_of(minimum.compute(state))
        expected = mesh_reference.fields_of(one.compute(state))
        assert all(found[name] == pytest.approx(expected[name], abs=1e-5) for name in found)


def test_a_new_cloud_takes_the_place_of_the_old_one():
    rng = np.random.default_rng(4)
    line = np.linspace((-1.0, 0.0, 0.3), (1.0, 0.0, 0.3), 20)
    obstacle = _distance.CloudObstacle(_distance.PointCloud(scattered(rng, 500)), RADIUS)
    minimum = _distance.MinimumDistance([obstacle], MARGIN, BAND)
    for count in (800, 1, 300):
        minimum.compute(line[None])
        points = scattered(rng, count)
        fresh_cloud = _distance.PointCloud(points)
        minimum.replace(0, _distance.CloudObstacle(fresh_cloud, RADIUS))
        found = mesh_reference.fields_of(minimum.compute(line[None]))
        fresh = mesh_reference.fields_of(calculator(points).compute(line[None]))
        assert all((found[name] == fresh[name]).all() for name in found)


@pytest.mark.parametrize("points", [np.zeros((0, 3)), np.full((5, 3), np.nan)])
def test_without_points_there_is_nothing_to_keep_off(points):
    cloud = _distance.PointCloud(points)
    assert (len(cloud), cloud.left_out, cloud.bytes) == (0, len(points), 0)
    line = np.array([(-1.0, 0.0, 0.0), (1.0, 0.0, 0.0)])
    empty = _distance.CloudObstacle(cloud, RADIUS)
    found = _distance.MinimumDistance([empty], MARGIN, BAND).compute(np.stack((line, line)))
    assert (found.minimum == np.inf).all() and len(found.distance) == 0
    full = _distance.CloudObstacle(_distance.PointCloud(np.zeros((1, 3))), RADIUS)
    found = _distance.MinimumDistance([empty, full], MARGIN, BAND).compute(line[None])
    assert found.obstacle.tolist() == [1]


@pytest.mark.parametrize("kind", [np.float32, np.float64])
def test_points_that_are_none_are_left_out(kind):
    points = np.zeros((6, 3), dtype=kind)
    points[0, 1], points[2, 2], points[3, 0], points[5, 1] = np.nan, np.inf, -2e6, 1e6
    cloud = _distance.PointCloud(points)
    assert (len(cloud), cloud.left_out) == (3, 3)


def test_memory_is_small():
    points = scattered(np.random.default_rng(5), 100_000)
    assert _distance.PointCloud(points).bytes < 20 * len(points)


def test_points_far_from_the_origin_keep_their_places():
    points = scattered(np.random.default_rng(6), 300) + (5e5, -9e5, 0.0)
    line = np.linspace((-1.0, 0.0, 0.3), (1.0, 0.0, 0.3), 20) + (5e5, -9e5, 0.0)
    least = reference.element_distances(points, line).min() - RADIUS - MARGIN
    assert calculator(points).compute(line[None]).minimum[0] == pytest.approx(least, abs=2e-6)


@pytest.mark.parametrize("points", [np.zeros(3), np.zeros((4, 2)), np.full((2, 3), "a"), None])
def test_no_points(points):
    with pytest.raises((ValueError, TypeError)):
        _distance.PointCloud(points)


@pytest.mark.parametrize("radius", [-1e-9, np.nan, np.inf])
def test_no_radius(radius):
    with pytest.raises(ValueError, match="radius is"):
        _distance.CloudObstacle(_distance.PointCloud(np.zeros((1, 3))), radius)
