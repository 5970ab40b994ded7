"""Signed distances on a grid: against interpolation in numpy at many points."""

import mesh_reference
import numpy as np
import pytest

from deformable_manipulation import _distance

ORIGIN, SPACING = np.array((-0.5, 0.25, 1.0)), np.array((0.1, 0.125, 0.2))
TOLERANCE = 2.1e-5  # m, of two minima, each to 1e-5 m


def grid_points(shape):
    index = np.stack(np.meshgrid(*map(np.arange, shape), indexing="ij"), axis=-1)
    return ORIGIN + SPACING * index


def plane(shape, rng):
    """A wall, whose distance is linear."""
    return grid_points(shape) @ (0.6, -0.48, 0.64) - 0.7


def ball(shape, rng):
    return (
        np.linalg.norm(grid_points(shape) - grid_points(shape).mean(axis=(0, 1, 2)), axis=-1) - 0.2
    )


def rough(shape, rng):
    """No distance of anything: the interpolation's products are as large as they can be."""
    return rng.normal(size=shape) * 0.1


def holes(shape, rng):
    return np.where(rng.random(shape) < 0.2, -0.2, 0.3)


FIELDS = pytest.mark.parametrize("values_of", [plane, ball, rough, holes])
OUTSIDE = pytest.mark.parametrize("is_free", [True, False])
SHAPE = (9, 7, 5)


def field(values, is_free):
    return _distance.FieldObstacle(values, ORIGIN, SPACING, is_free)


def calculator(values, is_free, margin=0.0, band=0.2):
    return _distance.MinimumDistance([field(values, is_free)], margin, band)


def interpolated(values, points):
    """At points (K, 3) of the grid's frame, within the grid: one axis after another."""
    places = (points - ORIGIN) / SPACING
    cell = np.clip(np.floor(places).astype(int), 0, np.array(values.shape) - 2)
    part = places - cell
    result = 0.0
    for corner in np.ndindex(2, 2, 2):
        share = np.prod(np.where(corner, part, 1.0 - part), axis=-1)
        result = result + share * values[tuple((cell + corner).T)]
    return result


def signed(values, points, is_free):
    """What the field is at points (K, 3), anywhere."""
    low, high = ORIGIN, ORIGIN + SPACING * (np.array(values.shape) - 1)
    on_border = np.clip(points, low, high)
    away = np.linalg.norm(points - on_border, axis=1)
    at_border = interpolated(values, on_border)
    if is_free:
        return np.where(at_border >= 0.0, np.hypot(away, at_border), at_border + away)
    border = np.minimum(points - low, high - points).min(axis=1)
    return np.minimum(at_border, np.where(away > 0.0, -away, border))


def objects(seed, is_surface):
    rng = np.random.default_rng(seed)
    middle = ORIGIN + 0.5 * SPACING * (np.array(SHAPE) - 1)
    for size in (0.03, 0.3, 1.0, 3.0):
        place = middle + rng.normal(size=3) * rng.choice((0.1, 0.6))
        points, triangles = mesh_reference.sheet(rng, cells=2, size=size, middle=place)
        yield points, triangles if is_surface else None
    level = points.copy()
    level[:, 2] = ORIGIN[2] + 0.2  # in a plane of the grid
    yield level, triangles if is_surface else None


def least_of(values, corners, is_free, rounds=4, count=24):
    """Least values (E,) of elements (E, 3, 3), by samples that become denser around the best."""
    grid = [(i, j, count - i - j) for i in range(count + 1) for j in range(count + 1 - i)]
    weights, reach = np.array(grid) / count, 1.0
    middle = np.full((len(corners), 3), 1.0 / 3.0)
    least = np.full(len(corners), np.inf)
    for _ in range(rounds):
        tried = np.clip(middle[:, None] + reach * (weights - 1.0 / 3.0), 0.0, 1.0)
        tried /= tried.sum(axis=2, keepdims=True)
        points = np.einsum("ekw,ewd->ekd", tried, corners)
        found = signed(values, points.reshape(-1, 3), is_free).reshape(len(corners), -1)
        best = np.argmin(found, axis=1)
        better = found.min(axis=1) < least
        least = np.minimum(least, found.min(axis=1))
        rows = np.flatnonzero(better)
        middle[rows] = tried[rows, best[rows]]
        reach *= 0.15
    return least


@OUTSIDE
@FIELDS
def test_points(values_of, is_free):
    rng = np.random.default_rng(1)
    values = values_of(SHAPE, rng).astype(np.float32)
    points = ORIGIN + 0.4 + rng.normal(size=(300, 3)) * 0.5
    copies = np.stack((points, points), axis=1)
    found = calculator(values, is_free).compute(copies)
    assert found.minimum == pytest.approx(signed(values, points, is_free), abs=1e-6)


@pytest.mark.parametrize("is_surface", [False, True])
@OUTSIDE
@FIELDS
def test_elements(values_of, is_free, is_surface):
    values = values_of(SHAPE, np.random.default_rng(2)).astype(np.float32)
    minimum = calculator(values, is_free)
    for points, triangles in objects(3, is_surface):
        elements = triangles if is_surface else np.array([(i, i + 1, i + 1) for i in range(8)])
        sampled = least_of(values, points[elements], is_free)
        found = minimum.compute(points[None], triangles)
        assert found.minimum[0] <= sampled.min() + TOLERANCE
        # What is found is nowhere lower than the field there.
        at = signed(values, found.object_point, is_free)
        assert found.distance == pytest.approx(at, abs=1e-6)
        assert np.diff(found.distance).min(initial=0.0) >= 0.0
        of = {tuple(vertices): d for vertices, d in zip(found.vertices, found.distance)}
        for vertices, value in zip(elements, sampled):
            if value <= found.minimum[0] + 0.2 - TOLERANCE:
                assert of[tuple(vertices)] <= value + TOLERANCE


@pytest.mark.parametrize("is_surface", [False, True])
@OUTSIDE
def test_what_is_found_depends_little_on_calls_before(is_free, is_surface):
    rng = np.random.default_rng(7)
    values = ball(SHAPE, rng).astype(np.float32)
    minimum = calculator(values, is_free)
    points, triangles = mesh_reference.sheet(rng, cells=3, size=0.4, middle=ORIGIN + 0.5)
    triangles = triangles if is_surface else None
    for step in range(40):
        points = points + 0.01 * rng.normal(size=3) + 0.5 * rng.normal(size=3) * (step % 10 == 0)
        points = ORIGIN + 0.5 + (points - points.mean(axis=0)) + 0.3 * rng.normal(size=3)
        found = minimum.compute(points[None], triangles)
        fresh = calculator(values, is_free).compute(points[None], triangles)
        assert found.minimum == pytest.approx(fresh.minimum, abs=TOLERANCE)
        limit = fresh.minimum[0] + 0.2 - TOLERANCE
        ours, theirs = found.distance <= limit, fresh.distance <= limit
        assert found.distance[ours] == pytest.approx(fresh.distance[theirs], abs=TOLERANCE)


def test_minima_of_a_segment_are_those_of_its_cubics():
    """On a segment within a cell the function is a cubic, whose minimum is at an end or a root."""
    rng = np.random.default_rng(4)
    values = rough(SHAPE, rng).astype(np.float32)
    minimum = calculator(values, True)
    for _ in range(200):
        cell = rng.integers(0, np.array(SHAPE) - 1)
        ends = ORIGIN + SPACING * (cell + rng.random((2, 3)))
        along = np.linspace(0.0, 1.0, 4)
        at = interpolated(values, ends[0] + along[:, None] * (ends[1] - ends[0]))
        cubic = np.polynomial.Polynomial.fit(along, at, 3)
        roots = cubic.deriv().roots()
        inside = roots.real[(np.abs(roots.imag) < 1e-12) & (roots.real > 0.0) & (roots.real < 1.0)]
        expected = min([at[0], at[-1], *cubic(inside)])
        assert minimum.compute(ends[None]).minimum[0] == pytest.approx(expected, abs=TOLERANCE)


def test_normals_are_the_gradient():
    rng = np.random.default_rng(5)
    values = ball(SHAPE, rng).astype(np.float32)
    points = ORIGIN + SPACING * (np.array(SHAPE) - 1) * rng.random((100, 3))
    found = calculator(values, True).compute(np.stack((points, points), axis=1))
    rows = found.offsets[:-1]
    step = 1e-5
    gradient = np.stack(
        [
            interpolated(values, points + step * axis) - interpolated(values, points - step * axis)
            for axis in np.eye(3)
        ],
        axis=1,
    )
    normal = gradient / np.linalg.norm(gradient, axis=1, keepdims=True)
    close = np.abs((points - ORIGIN) / SPACING % 1.0 - 0.5).max(axis=1) < 0.49  # within a cell
    assert found.normal[rows][close] == pytest.approx(normal[close], abs=1e-4)
    foot = points - found.distance[rows, None] * found.normal[rows]
    assert found.obstacle_point[rows] == pytest.approx(foot, abs=1e-12)


def test_a_level_rope_over_a_wall_has_its_features_in_the_middle():
    values = (grid_points(SHAPE)[..., 2] - 1.1).astype(np.float32)
    line = np.array([(-0.4, 0.5, 1.3), (0.1, 0.6, 1.3), (0.2, 0.9, 1.3)])
    found = calculator(values, True).compute(line[None])
    assert found.distance == pytest.approx((0.2, 0.2), abs=1e-6)
    assert found.weights[:, :2] == pytest.approx(0.5)


def test_a_moved_field():
    rng = np.random.default_rng(6)
    values, line = rough(SHAPE, rng).astype(np.float32), rng.normal(size=(6, 3)) * 0.3 + ORIGIN
    obstacle = field(values, True)
    angular, shift = np.array((0.1, 0.2, -0.4)), np.array((5.0, -2.0, 1.0))
    obstacle.set_pose(shift, (0.0, 0.0, 0.6, 0.8), (1.0, 0.0, 0.0), angular)
    turn = np.array([(0.28, -0.96, 0.0), (0.96, 0.28, 0.0), (0.0, 0.0, 1.0)])
    moved = _distance.MinimumDistance([obstacle], 0.0, 0.2).compute((line @ turn.T + shift)[None])
    expected = calculator(values, True).compute(line[None])
    assert moved.distance == pytest.approx(expected.distance, abs=TOLERANCE)
    velocity = (1.0, 0.0, 0.0) + np.cross(angular, moved.obstacle_point - shift)
    assert moved.obstacle_velocity == pytest.approx(velocity, abs=1e-12)


def test_large_triangles_over_fine_grids_end():
    shape = (60, 60, 60)
    values = (np.linalg.norm(grid_points(shape) - (2.0, 3.0, 6.0), axis=-1) - 1.0).astype(
        np.float32
    )
    corners = np.array([(-50.0, -40.0, 7.5), (60.0, -40.0, 7.6), (0.0, 90.0, 7.7)])
    found = calculator(values, True).compute(corners[None], np.array([[0, 1, 2]]))
    assert found.minimum[0] == pytest.approx(0.6, abs=0.1)


@pytest.mark.parametrize(
    "arguments, told",
    [
        ((np.zeros((2, 2)), ORIGIN, SPACING), "shape .X, Y, Z."),
        ((np.zeros((1, 2, 2)), ORIGIN, SPACING), "two values at least"),
        ((np.full((2, 2, 2), np.nan), ORIGIN, SPACING), "value 0 is not finite"),
        ((np.zeros((2, 2, 2)), (0.0, np.inf, 0.0), (0.0, 1.0, 1.0)), "origin.*\n.*spacing"),
    ],
)
def test_grids_refused(arguments, told):
    with pytest.raises(ValueError, match=told):
        _distance.FieldObstacle(*arguments, True)
