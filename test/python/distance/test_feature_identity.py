"""Features keep their numbers from call to call."""

import mesh_reference as reference
import numpy as np
import pytest
from mesh_reference import fields, grid_triangles

from deformable_manipulation import _distance

STEPS = 60


def cycles(obstacles, features, states, triangles=None, band=0.05):
    """Fields of Distances of one state after the other."""
    calculator = _distance.MinimumDistance(obstacles, 0.0, band, features)
    for state in states:
        copies = np.stack((state, state + 0.01))
        yield fields(calculator, copies, triangles)


def own(result, name):
    """A field of the features of copy 0."""
    return result[name][: result["offsets"][1]]


def sliding_rope():
    """Sags onto a wall along the x axis, and is pulled to and fro across it, and along it."""
    along = np.linspace(-0.8, 0.8, 30)
    for step in range(STEPS):
        y = along + 0.25 * np.sin(0.1 * step)
        yield np.column_stack((np.full(30, 0.2 + 0.01 * step), y, 1.02 + 0.3 * y**2))


@pytest.mark.parametrize("kind", ["mesh", "polygon"])
def test_one_local_minimum_slides_over_segments(kind):
    if kind == "mesh":
        obstacle = _distance.MeshObstacle(*reference.cube((-0.2, -0.01, 0.0), (1.2, 0.01, 1.0)))
    else:
        obstacle = _distance.PlanarObstacle([(-0.01, 0), (0.01, 0), (0.01, 1), (-0.01, 1)], "yz")
    seen = list(cycles([obstacle], "local", sliding_rope()))
    assert len({tuple(own(result, "vertices")[0]) for result in seen}) > 3
    assert {tuple(own(result, "identity")) for result in seen} == {(0,)}
    assert all((result["identity"][result["offsets"][1] :] == -1).all() for result in seen)


def test_a_rope_along_an_edge_has_a_number_per_segment():
    obstacle = _distance.MeshObstacle(*reference.cube())
    line = np.linspace([0.0, 0.0, 1.02], [1.0, 0.0, 1.02], 11)
    waves = (line + [0, 0.01 * np.sin(s), 0.01 * np.cos(s)] for s in range(10))
    for result in cycles([obstacle], "elements", waves):
        assert own(result, "identity").tolist() == own(result, "vertices")[:, 0].tolist()
        assert len(own(result, "identity")) == 10


def test_a_fabric_over_the_corners_of_a_cube():
    """Four minima that keep apart, while the fabric slides over them and tilts."""
    pillars = reference.joined(
        *(
            reference.cube((x, y, 0.0), (x + 0.02, y + 0.02, 1.0))
            for x in (0.1, 0.9)
            for y in (0.15, 0.8)
        )
    )
    x, y = np.meshgrid(*2 * [np.linspace(-0.6, 1.6, 12)], indexing="ij")
    height = np.full_like(x, 1.2)
    for cx in (0.11, 0.91):
        for cy in (0.16, 0.81):
            height = np.minimum(height, 1.03 + 0.8 * ((x - cx) ** 2 + (y - cy) ** 2))
    sheet = np.stack((x, y, height), axis=-1).reshape(-1, 3)

    def states():
        for step in range(STEPS):
            shift = [0.003 * step, -0.002 * step, 0.0002 * (step % 7)]
            yield sheet + shift

    obstacle = _distance.MeshObstacle(*pillars)
    corner_of = {}
    for result in cycles([obstacle], "local", states(), grid_triangles(11), band=0.1):
        places = np.round(own(result, "obstacle_point")[:, :2] / 0.7).astype(int)
        assert len({tuple(place) for place in places}) == 4
        for number, place in zip(own(result, "identity"), places):
            assert corner_of.setdefault(number, tuple(place)) == tuple(place)
        assert len(set(own(result, "identity"))) == len(own(result, "identity"))


def test_a_lost_feature_s_number_does_not_come_back():
    obstacle = _distance.MeshObstacle(*reference.cube())
    along = np.linspace(0.1, 0.9, 11)
    left = np.column_stack((along, 0.5 + 0.0 * along, 1.1 + (along - 0.1) ** 2))
    right = np.column_stack((along, 0.5 + 0.0 * along, 1.1 + (along - 0.9) ** 2))
    numbers = [tuple(r["identity"][:1]) for r in cycles([obstacle], "local", [left, right, left])]
    assert len(set(numbers)) == 3


def test_several_obstacles_have_numbers_of_their_own():
    obstacles = [_distance.MeshObstacle(*reference.cube()) for _ in range(2)]
    line = np.linspace([0.0, 0.5, 1.02], [1.0, 0.5, 1.02], 5)
    for features in ("local", "elements"):
        for result in cycles(obstacles, features, [line, line + 0.001]):
            assert len(set(own(result, "identity"))) == len(own(result, "identity"))
