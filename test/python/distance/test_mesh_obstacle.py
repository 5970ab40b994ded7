"""Meshes as obstacles: known distances, what counts as inside, mending, refusals."""

import mesh_reference as reference
import numpy as np
import pytest
from mesh_reference import compute, cube, grid_triangles, joined

from deformable_manipulation import _distance

ONE = np.array([[0, 1, 2]])


def minimum(mesh, points, triangles=None):
    return compute(mesh, points, triangles)["minimum"][0]


def warnings(mesh):
    return _distance.MeshObstacle(*mesh).warnings


@pytest.mark.parametrize(
    "corners, distance",
    [
        ([(0.2, 0.2, 1.3), (0.8, 0.2, 1.3), (0.5, 0.8, 1.3)], 0.3),  # level over a face
        ([(-3, -3, 1.1), (5, -3, 1.1), (0.5, 6, 1.1)], 0.1),  # around it, over it
        ([(0.4, 0.4, 0.9), (0.6, 0.4, 0.9), (0.5, 0.6, 0.9)], -0.1),  # level below a face
        ([(-3, -3, 0.5), (5, -3, 0.5), (0.5, 6, 0.5)], -0.5),  # through its middle
        ([(-3, -3, 0.3), (5, -3, 0.3), (0.5, 6, 0.3)], -0.3),
        ([(0.5, 0.5, 0.8), (0.0, 0.5, 2.0), (1.0, 0.5, 2.0)], -0.2),  # a corner in a face
        ([(2.0, 0.5, -1), (2.0, 0.5, 2), (1.25, 0.5, 0.5)], 0.25),  # a corner before a face
        ([(1.0, 2.0, 0.5), (2.0, 1.0, 0.5), (2.0, 2.0, 0.5)], np.sqrt(0.5)),  # edge to edge
        ([(1, 0.2, 0.2), (1, 0.8, 0.2), (1, 0.5, 0.8)], 0.0),  # on a face
    ],
)
def test_one_triangle_and_a_cube(corners, distance):
    assert minimum(cube(), np.array(corners), ONE) == pytest.approx(distance, abs=1.1e-5)


@pytest.mark.parametrize("poke", [1e-6, 1e-3, 0.02])
def test_a_corner_of_the_cube_pokes_through_a_coarse_fabric(poke):
    """All vertices are outside, by far."""
    normal = np.ones(3) / np.sqrt(3.0)
    across = np.linalg.qr(np.column_stack((normal, np.eye(3)[:, :2])))[0][:, 1:]
    line = np.array([(x, y) for x in (-1.0, 0.0, 1.1) for y in (-0.9, 0.1, 1.0)])
    points = np.ones(3) - poke * normal + line @ across.T
    result = compute(cube(), points, grid_triangles(2))
    assert (reference.signed_distances(cube(), points) > 0.05).all()
    assert result["minimum"][0] < 0.0
    # Along the corner's axis a point is as deep in each face.
    assert result["minimum"][0] == pytest.approx(-poke / np.sqrt(3.0), abs=1.1e-5, rel=1e-9)


def test_a_rod_through_a_cube_and_one_in_it():
    line = np.linspace([-1.0, 0.4, 0.7], [2.0, 0.4, 0.7], 7)
    assert minimum(cube(), line) == pytest.approx(-0.3, abs=1.1e-5)
    inside = np.linspace([0.1, 0.4, 0.95], [0.3, 0.4, 0.8], 3)
    result = compute(cube(), inside, margin=0.01)
    assert result["minimum"] == pytest.approx([-0.21], abs=1.1e-5)
    assert result["normal"][0] == pytest.approx([0.0, 0.0, 1.0], abs=1e-9)


def test_every_piece_of_the_object_counts():
    """One piece lies wholly inside, nearer to no face than the other."""
    near = np.array([(0.2, 0.2, 1.01), (0.8, 0.2, 1.01), (0.5, 0.8, 1.01)])
    deep = np.array([(0.4, 0.4, 0.5), (0.6, 0.4, 0.5), (0.5, 0.6, 0.5)])
    both = np.concatenate((near, deep))
    two = np.array([[0, 1, 2], [3, 4, 5]])
    assert minimum(cube(), both, two) == pytest.approx(-0.5, abs=1.1e-5)
    assert minimum(cube(), both, ONE) == pytest.approx(0.01, abs=1e-12)


@pytest.mark.parametrize("turned", ["none", "one", "half", "all"])
def test_winding_does_not_matter(turned):
    vertices, triangles = cube()
    triangles = triangles.copy()
    chosen = {"none": [], "one": [4], "half": range(0, 12, 2), "all": range(12)}[turned]
    triangles[chosen] = triangles[chosen, ::-1]
    line = np.array([(0.5, 0.5, 0.9), (0.5, 0.5, 3.0)])
    assert minimum((vertices, triangles), line) == pytest.approx(-0.1, abs=1.1e-5)
    found = warnings((vertices, triangles))
    assert len(found) == (turned != "none")
    assert all("wound the wrong way" in warning for warning in found)


def test_a_soup_of_triangles_is_welded():
    vertices, triangles = cube()
    soup = (vertices[triangles].reshape(-1, 3), np.arange(36).reshape(12, 3))
    assert warnings(soup) == []
    assert minimum(soup, [(0.5, 0.5, 0.9), (0.5, 0.5, 3.0)]) == pytest.approx(-0.1, abs=1.1e-5)


def test_an_open_mesh_has_no_sign_anywhere():
    vertices, triangles = cube()
    lidless = (vertices, triangles[:10])  # without the face z = 1
    assert any("not closed" in warning for warning in warnings(lidless))
    inside = [(0.5, 0.5, 0.9), (0.5, 0.5, 0.8)]
    assert minimum(lidless, inside) == pytest.approx(0.5, abs=1e-12)
    crossing = [(0.5, 0.5, 0.5), (2.0, 0.5, 0.5)]
    assert minimum(lidless, crossing) == pytest.approx(0.0, abs=1e-12)
    rng = np.random.default_rng(1)
    rim = np.array([(x, 1.0, 1.0) for x in rng.uniform(0, 1, 50)])
    for point in rim + rng.normal(scale=0.01, size=rim.shape):
        assert minimum(lidless, [point, point + 1e-6]) >= 0.0


def test_features_beside_an_open_mesh_are_those_of_the_object_itself():
    vertices, triangles = cube()
    lidless = (vertices, triangles[:10])
    sheet = np.array([(x, y, 1.2) for x in (0.1, 0.5, 0.9) for y in (0.1, 0.5, 0.9)])
    copies = sheet + np.array([0.0, 0.3, -0.5])[:, None, None] * [0.3, 0.2, 1.0]
    together = compute(lidless, copies, grid_triangles(2))
    alone = compute(lidless, sheet, grid_triangles(2))
    for name in reference.FIELDS[2:]:
        own = together[name][: together["offsets"][1]]
        np.testing.assert_array_equal(own, alone[name], err_msg=name)
    expected = reference.unsigned_distances(lidless, alone["object_point"])
    assert alone["distance"] == pytest.approx(expected, abs=1e-12)


def test_a_moebius_strip_has_no_sign():
    angles = np.linspace(0.0, 2.0 * np.pi, 20, endpoint=False)
    rows = []
    for side in (-0.2, 0.2):
        radius = 1.0 + side * np.cos(angles / 2.0)
        rows.append(
            np.column_stack(
                (radius * np.cos(angles), radius * np.sin(angles), side * np.sin(angles / 2.0))
            )
        )
    triangles = []
    for i in range(20):
        a, b = i, 20 + i
        c, d = (i + 1, 21 + i) if i < 19 else (20, 0)
        triangles += [(a, c, b), (c, d, b)]
    strip = (np.concatenate(rows), np.array(triangles))
    assert any("not closed" in warning for warning in warnings(strip))
    assert minimum(strip, [(1.0, 0.0, -0.5), (1.0, 0.0, 0.5)]) >= 0.0


def test_degenerate_and_repeated_triangles_are_dropped():
    vertices, triangles = cube()
    more = [(0, 0, 1), (3, 3, 3), (2, 0, 1)]
    spoilt = np.concatenate((triangles, more[:2], triangles[:1, ::-1]))
    texts = warnings((vertices, spoilt))
    assert "2 triangles without area are dropped" in texts
    assert "1 repeated triangle is dropped" in texts
    assert len(texts) == 2
    line = [(0.5, 0.5, 0.9), (0.5, 0.5, 3.0)]
    assert minimum((vertices, spoilt), line) == pytest.approx(-0.1, abs=1.1e-5)


def test_a_cavity_is_outside():
    shell = joined(cube((-2, -2, -2), (2, 2, 2)), (cube()[0], CUBE_INSIDE_OUT))
    assert warnings(shell) == []
    for point, distance in (((0.5, 0.5, 0.4), 0.4), ((0.5, 0.5, -0.3), -0.3), ((0, 0, 2.5), 0.5)):
        line = np.array([point, point]) + [[0, 0, 0], [1e-9, 0, 0]]
        assert minimum(shell, line) == pytest.approx(distance, abs=1.1e-5)


CUBE_INSIDE_OUT = reference.CUBE[:, ::-1]


def test_a_solid_in_a_solid_is_filled():
    nested = joined(cube((-2, -2, -2), (2, 2, 2)), cube())
    line = np.array([(0.5, 0.5, 0.4), (0.5, 0.5, 0.41)])
    assert minimum(nested, line) == pytest.approx(-1.5, abs=1.1e-5)


def test_overlapping_solids_count_one_by_one():
    overlapping = joined(cube(), cube((0.6, 0.0, 0.0), (1.6, 1.0, 1.0)))
    within_both = np.array([(0.75, 0.5, 0.5), (0.751, 0.5, 0.5)])
    assert minimum(overlapping, within_both) == pytest.approx(-0.25, abs=1.1e-5)
    at_a_hidden_face = np.array([(1.0, 0.5, 0.5), (1.0, 0.5, 0.501)])
    assert minimum(overlapping, at_a_hidden_face) == pytest.approx(-0.4, abs=1.1e-5)
    apart = joined(cube(), cube((3, 0, 0), (4, 1, 1)))
    assert minimum(apart, [(3.4, 0.5, 0.5), (3.4, 0.5, 2)]) == pytest.approx(-0.4, abs=1.1e-5)


@pytest.mark.parametrize("shift, size", [(9e5, 1.0), (0.0, 1e-4), (0.0, 1e5)])
def test_large_and_small_coordinates(shift, size):
    vertices, triangles = cube()
    mesh = (size * vertices + shift, triangles)
    line = size * np.array([(0.5, 0.5, 1.5), (0.5, 0.2, 1.2), (0.5, 0.5, 1.9)]) + shift
    assert minimum(mesh, line) == pytest.approx(0.2 * size, abs=1e-9, rel=1e-9)
    line[1, 2] = 0.9 * size + shift
    assert minimum(mesh, line) == pytest.approx(-0.1 * size, abs=1.1e-5, rel=1e-9)


@pytest.mark.parametrize("direction", [(1, 0, 0), (1, -2, 3), (0.3, 0.4, -5)])
def test_far_away(direction):
    mesh = reference.star(np.random.default_rng(7), 30, 40)
    away = 3e5 * np.array(direction) / np.linalg.norm(direction)
    points = away + np.array([(0, 0, 0), (0.3, 0.1, 0), (0, 0.5, 0.2)])
    result = compute(mesh, points, ONE)
    expected = reference.unsigned_distances(mesh, points).min()
    assert result["minimum"][0] <= expected + 1e-9
    at = reference.unsigned_distances(mesh, result["object_point"])
    assert result["distance"] == pytest.approx(at, abs=1e-9)


def test_a_level_triangle_is_represented_by_its_middle():
    corners = np.array([(0.2, 0.2, 1.1), (0.8, 0.2, 1.1), (0.5, 0.8, 1.1)])
    assert compute(cube(), corners, ONE)["weights"] == pytest.approx(np.full((1, 3), 1 / 3))
    corners[2, 2] = 1.2
    assert compute(cube(), corners, ONE)["weights"] == pytest.approx(np.array([[0.5, 0.5, 0.0]]))


@pytest.mark.parametrize(
    "vertices, triangles, reason",
    [
        (cube()[0], np.zeros((0, 3), int), "triangles >= 1"),
        (cube()[0], [[0, 1, 8]], "refers to vertex 8"),
        (cube()[0], [[0, 1, -1]], "refers to vertex -1"),
        (cube()[0], [[0.0, 1.0, 2.0]], "whole numbers"),
        (cube()[0], [[0, 1, 1]], "no triangle with an area"),
        (cube()[0] * [1, 1, np.nan], CUBE_INSIDE_OUT, "vertex 0 is not finite"),
        (cube()[0] * 2e6, CUBE_INSIDE_OUT, "beyond 1e6 m"),
        (np.zeros((0, 3)), [[0, 0, 0]], "refers to vertex 0"),
        (np.zeros((3, 2)), [[0, 1, 2]], r"\(vertices, 3\)"),
    ],
)
@pytest.mark.filterwarnings("ignore:invalid value")
def test_meshes_that_are_none(vertices, triangles, reason):
    with pytest.raises(ValueError, match=reason):
        _distance.MeshObstacle(vertices, triangles)


def test_all_mistakes_at_once():
    with pytest.raises(ValueError) as caught:
        _distance.MeshObstacle(2e6 * cube()[0], cube()[1], (np.nan, 0, 0), (0, 0, 0, 2))
    for part in ("vertex", "translation", "rotation"):
        assert part in str(caught.value)
