"""Half-spaces, spheres, boxes, cylinders and capsules: against formulas on many points."""

import mesh_reference
import numpy as np
import primitive_reference as reference
import pytest

from deformable_manipulation import _distance

ONE = np.array([[0, 1, 2]])
LEVELS = (0.0, 0.15, 0.3, 0.35, 0.4, 0.5)  # m, where the solids have faces, edges and middles
SAME = 1e-9  # m, what is as near
KINDS = list(reference.MAKERS)
NAMED = pytest.mark.parametrize("kind", KINDS)


def calculator(kind, band=0.3, margin=0.0):
    return _distance.MinimumDistance([reference.MAKERS[kind]()], margin, band)


def elements(seed, corners, count=30):
    """Segments or triangles near the origin, of all sizes; some level with faces or in them."""
    rng = np.random.default_rng(seed)
    for number in range(count):
        middle = rng.normal(size=3) * rng.choice((0.1, 0.4, 1.0))
        points = middle + rng.choice((0.05, 0.3, 1.0)) * rng.normal(size=(corners, 3))
        if number % 3 == 0:
            points[:, rng.integers(3)] = rng.choice(LEVELS) * rng.choice((-1.0, 1.0))
        if number % 7 == 0:
            points[:, :2] *= 1e-3  # along the axis
        yield points


@NAMED
def test_segments(kind):
    minimum = calculator(kind)
    for points in elements(1, 2):
        expected = reference.least_of_segment(reference.SIGNED[kind], points)
        assert minimum.compute(points[None]).minimum[0] == pytest.approx(expected, abs=SAME)


@NAMED
def test_triangles(kind):
    minimum = calculator(kind)
    for points in elements(2, 3):
        expected = reference.least_of_triangle(reference.SIGNED[kind], points)
        assert minimum.compute(points[None], ONE).minimum[0] == pytest.approx(expected, abs=SAME)


@NAMED
def test_solids_that_come_through_a_large_triangle(kind):
    """All its corners and edges are far away."""
    rng = np.random.default_rng(3)
    minimum = calculator(kind)
    for _ in range(8):
        turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        flat = np.array([(3.0, 0.0, 0.0), (-2.0, 2.5, 0.0), (-2.0, -2.5, 0.0)])
        points = (flat + (0.0, 0.0, rng.uniform(-0.5, 0.5))) @ turn
        expected = reference.least_of_triangle(reference.SIGNED[kind], points)
        assert minimum.compute(points[None], ONE).minimum[0] == pytest.approx(expected, abs=SAME)


@NAMED
@pytest.mark.parametrize("is_surface", [False, True])
def test_features_of_a_whole_object(kind, is_surface):
    rng = np.random.default_rng(4)
    signed = reference.SIGNED[kind]
    for _ in range(3):
        middle = rng.normal(size=3) * rng.choice((0.2, 0.6))
        points, triangles = mesh_reference.sheet(rng, cells=4, size=0.8, middle=middle)
        if is_surface:
            corners = points[triangles]
            least = np.array([reference.least_of_triangle(signed, each) for each in corners])
        else:
            triangles = None
            least = reference.least_of_segments(signed, points[:-1], points[1:])
        found = calculator(kind, margin=0.01).compute(points[None], triangles)
        limit = found.minimum[0] + 0.3
        assert found.minimum[0] == pytest.approx(least.min() - 0.01, abs=SAME)
        assert np.abs(np.sort(found.distance) - found.distance).max() == 0.0
        near = np.sort(least[least - 0.01 <= limit]) - 0.01
        assert found.distance == pytest.approx(near, abs=SAME)
        _check_points(found, points, signed)


def _check_points(found, points, signed):
    """Object points lie on the object, obstacle points on the surface, a distance apart."""
    places = np.einsum("mk,mki->mi", found.weights, points[found.vertices])
    distance = found.distance + 0.01
    assert places == pytest.approx(found.object_point, abs=1e-12)
    assert signed(found.object_point) == pytest.approx(distance, abs=1e-12)
    assert signed(found.obstacle_point) == pytest.approx(0.0, abs=1e-9)
    assert np.linalg.norm(found.normal, axis=1) == pytest.approx(1.0)
    arm = found.object_point - found.obstacle_point
    assert arm == pytest.approx(distance[:, None] * found.normal, abs=1e-9)


@NAMED
def test_a_moved_solid_is_where_the_object_would_be_moved_to(kind):
    rng = np.random.default_rng(5)
    line = np.cumsum(rng.normal(size=(8, 3)) * 0.2, axis=0)
    rotation = rng.normal(size=4)
    rotation /= np.linalg.norm(rotation)
    x, y, z, w = rotation
    turn = np.array(
        [
            (1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
            (2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)),
            (2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)),
        ]
    )
    shift = np.array((0.5, -2.0, 3.0))
    expected = calculator(kind).compute(line[None])
    obstacle = reference.MAKERS[kind]()
    linear, angular = np.array((0.1, 0.2, -0.3)), np.array((1.0, -2.0, 0.5))
    obstacle.set_pose(shift, rotation, linear, angular)
    moved = _distance.MinimumDistance([obstacle], 0.0, 0.3).compute((line @ turn.T + shift)[None])
    assert moved.distance == pytest.approx(expected.distance, abs=1e-9)
    outside = expected.distance > SAME  # within, two faces may be as near
    normal, point = expected.normal @ turn.T, expected.obstacle_point @ turn.T + shift
    assert moved.normal[outside] == pytest.approx(normal[outside], abs=1e-6)
    assert moved.obstacle_point[outside] == pytest.approx(point[outside], abs=1e-6)
    velocity = linear + np.cross(angular, moved.obstacle_point - shift)
    assert moved.obstacle_velocity == pytest.approx(velocity, abs=1e-12)


def test_every_copy_has_its_minimum():
    rng = np.random.default_rng(6)
    copies = np.cumsum(rng.normal(size=(13, 20, 3)) * 0.1, axis=1)
    found = calculator("cylinder").compute(copies)
    for copy, line in enumerate(copies):
        assert found.minimum[copy] == calculator("cylinder").compute(line[None]).minimum[0]


@pytest.mark.parametrize("kind, height", [("box", 0.15), ("cylinder", 0.4)])
def test_what_lies_level_over_a_face_has_its_feature_in_the_middle(kind, height):
    """Otherwise features would jump from end to end while the object rocks by nothing."""
    above = np.array([(-0.1, 0.0, 0.2), (0.2, 0.0, 0.2)]) + (0.0, 0.0, height)
    found = calculator(kind).compute(above[None])
    assert found.weights[0] == pytest.approx((0.5, 0.5, 0.0), abs=1e-6)
    beyond = np.array([(-2.0, 0.0, 0.2), (1.0, 0.0, 0.2)]) + (0.0, 0.0, height)
    found = calculator(kind).compute(beyond[None])
    assert found.object_point[0] == pytest.approx((0.0, 0.0, height + 0.2), abs=1e-4)
    triangle = np.array([(-0.1, -0.1, 0.2), (0.2, -0.1, 0.2), (0.1, 0.2, 0.2)])
    found = calculator(kind).compute((triangle + (0.0, 0.0, height))[None], ONE)
    assert found.weights[0] == pytest.approx(np.full(3, 1.0 / 3.0), abs=1e-6)


def test_a_collapsed_triangle_is_a_segment():
    points = np.array([(-1.0, 0.1, 0.5), (1.0, 0.1, 0.5), (0.0, 0.1, 0.5)])
    assert calculator("sphere").compute(points[None], ONE).minimum[0] == pytest.approx(
        np.hypot(0.1, 0.5) - 0.4, abs=SAME
    )
    point = np.tile((0.1, 0.2, 0.9), (3, 1))
    assert calculator("box").compute(point[None], ONE).minimum[0] == pytest.approx(0.75, abs=SAME)


@pytest.mark.parametrize(
    "make, told",
    [
        (lambda make: make.sphere(0.0), "radius is 0; it must be above 0 and at most 1e6 m"),
        (lambda make: make.sphere(float("nan")), "radius is nan"),
        (lambda make: make.box((1.0, -1.0, 2e6)), "a side is -1.*\na side is 2e"),
        (lambda make: make.cylinder(-1.0, float("inf")), "radius is -1.*\nlength is inf"),
        (lambda make: make.capsule(1.0, 0.0), "length is 0"),
        (lambda make: make.half_space((0.0, 0.0, 0.0)), "normal is 0 0 0"),
    ],
)
def test_sizes_refused(make, told):
    with pytest.raises(ValueError, match=told):
        make(_distance.PrimitiveObstacle)


def test_poses_refused():
    obstacle = _distance.PrimitiveObstacle.sphere(1.0)
    with pytest.raises(ValueError, match="translation is .*nan.*\nrotation is 1 1 0 0"):
        obstacle.set_pose((float("nan"), 0.0, 0.0), (1.0, 1.0, 0.0, 0.0))
