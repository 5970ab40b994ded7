"""Random surfaces and lines beside random meshes, against a search over points and triangles."""

import mesh_reference as reference
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mesh_reference import compute, fields, sheet, star
from scipy.spatial.transform import Rotation

from deformable_manipulation import _distance

TOLERANCE = 1.1e-5  # m, of depths
BAND = 0.3
seeds = st.integers(0, 2**32 - 1)
MANY = settings(max_examples=25, deadline=None)


def scene(seed):
    """A mesh, points of an object, and its triangles or None."""
    rng = np.random.default_rng(seed)
    mesh = star(rng) if rng.random() < 0.6 else reference.cube(-rng.uniform(0.2, 1, 3), (1, 1, 1))
    points, triangles = sheet(
        rng, size=rng.uniform(0.1, 2.5), waves=rng.uniform(0, 0.4), middle=rng.uniform(-1.2, 1.2, 3)
    )
    if rng.random() < 0.3:
        return mesh, points[:7], None
    return mesh, points, triangles


def elements_of(points, triangles):
    if triangles is not None:
        return triangles
    return np.array([(i, i + 1, i + 1) for i in range(len(points) - 1)])


@MANY
@given(seed=seeds)
def test_every_element_has_its_least_signed_distance(seed):
    mesh, points, triangles = scene(seed)
    result = compute(mesh, points, triangles, BAND)
    elements = elements_of(points, triangles)
    bounds = reference.element_bounds(mesh, points, elements)
    minimum = result["minimum"][0]
    assert bounds[:, 0].min() - 1e-9 <= minimum <= bounds[:, 1].min() + TOLERANCE
    found = dict(zip(map(tuple, result["vertices"]), result["distance"]))
    assert len(found) == len(result["distance"])
    for element, (low, high) in zip(map(tuple, elements), bounds):
        if element in found:
            assert low - 1e-9 <= found[element] <= high + TOLERANCE
        else:
            assert high > minimum + BAND - TOLERANCE


@MANY
@given(seed=seeds)
def test_witnesses(seed):
    mesh, points, triangles = scene(seed)
    result = compute(mesh, points, triangles, BAND)
    distance, at = result["distance"], result["object_point"]
    assert distance == pytest.approx(reference.signed_distances(mesh, at), abs=1e-9)
    on_surface = reference.unsigned_distances(mesh, result["obstacle_point"])
    assert on_surface == pytest.approx(0.0, abs=1e-9)
    arm = at - result["obstacle_point"]
    assert arm == pytest.approx(distance[:, None] * result["normal"], abs=1e-8)
    assert np.linalg.norm(result["normal"], axis=1) == pytest.approx(1.0)
    material = np.einsum("mk,mkd->md", result["weights"], points[result["vertices"]])
    assert at == pytest.approx(material, abs=1e-12)
    assert (result["weights"] >= 0.0).all()
    assert result["weights"].sum(axis=1) == pytest.approx(1.0)


@MANY
@given(seed=seeds)
def test_results_do_not_depend_on_calls_before(seed):
    rng = np.random.default_rng(seed)
    mesh, points, triangles = scene(seed)
    copies = points + rng.normal(scale=0.1, size=(5, 1, 3))
    obstacle = _distance.MeshObstacle(*mesh)
    used = _distance.MinimumDistance([obstacle], 0.01, BAND)
    for shift in (0.0, 0.3, -1.5):
        used.compute(copies[::-1] + shift, triangles)
    fresh = _distance.MinimumDistance([_distance.MeshObstacle(*mesh)], 0.01, BAND)
    together, alone = fields(used, copies, triangles), fields(fresh, copies, triangles)
    for name in reference.FIELDS[:-1]:
        np.testing.assert_array_equal(together[name], alone[name], err_msg=name)
    for copy in range(1, 5):
        single = compute(mesh, copies[copy], triangles, margin=0.01)
        assert together["minimum"][copy] == pytest.approx(single["minimum"][0], abs=TOLERANCE)


@MANY
@given(seed=seeds, step=st.sampled_from([1e-4, 3e-3, 0.05]))
def test_results_do_not_depend_on_the_way_there(seed, step):
    rng = np.random.default_rng(seed)
    mesh, points, triangles = scene(seed)
    copies = points + rng.normal(scale=0.1, size=(3, 1, 3))
    obstacle = _distance.MeshObstacle(*mesh)
    used = _distance.MinimumDistance([obstacle], 0.0, BAND)
    way = rng.normal(size=3)
    for _ in range(12):
        copies = copies + step * (way + 0.3 * rng.normal(size=copies.shape))
        pose = step * rng.normal(size=3), Rotation.from_rotvec(step * rng.normal(size=3)).as_quat()
        obstacle.set_pose(*pose)
        found = fields(used, copies, triangles)
    fresh = _distance.MinimumDistance([_distance.MeshObstacle(*mesh, *pose)], 0.0, BAND)
    alone = fields(fresh, copies, triangles)
    for name in reference.FIELDS[:-1]:
        np.testing.assert_array_equal(found[name], alone[name], err_msg=name)


@MANY
@given(seed=seeds, size=st.sampled_from([1e-3, 1.0, 1e4]))
def test_moving_everything_rigidly_changes_no_distance(seed, size):
    rng = np.random.default_rng(seed)
    (vertices, faces), points, triangles = scene(seed)
    mesh, points = (size * vertices, faces), size * points
    plain = compute(mesh, points, triangles, size * BAND)
    rotation, translation = Rotation.random(random_state=seed), size * rng.uniform(-3, 3, 3)
    obstacle = _distance.MeshObstacle(*mesh)
    calculator = _distance.MinimumDistance([obstacle], 0.0, size * BAND)
    calculator.compute(points[None], triangles)
    linear, angular = rng.uniform(-1.0, 1.0, (2, 3))
    obstacle.set_pose(translation, rotation.as_quat(), linear, angular)
    moved = fields(calculator, (rotation.apply(points) + translation)[None], triangles)
    assert moved["minimum"] == pytest.approx(plain["minimum"], abs=TOLERANCE + 1e-9 * size)
    arm = moved["obstacle_point"] - translation
    assert moved["obstacle_velocity"] == pytest.approx(linear + np.cross(angular, arm))
