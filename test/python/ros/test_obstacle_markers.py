import dataclasses
import gzip

import numpy as np
import pytest
from std_msgs.msg import Header
from visualization_msgs.msg import Marker

from deformable_manipulation.distance.factory import make_minimum_distance
from deformable_manipulation.obstacles.primitives import Sphere, SphereObstacle
from deformable_manipulation.ros.obstacle_markers import distance_markers, obstacle_markers
from deformable_manipulation.scenario import load_scenario, package_share_directory
from deformable_manipulation.scenario.spec import MeshObstacle, PolygonObstacle, TopicMotion


@pytest.fixture(scope="module")
def scenario():
    return load_scenario("rope_one_assistant")


@pytest.fixture(scope="module")
def triangles(scenario):
    (marker,) = obstacle_markers(scenario.obstacles, "map").markers
    points = np.array([(p.x, p.y, p.z) for p in marker.points])
    colors = np.array([(c.r, c.g, c.b, c.a) for c in marker.colors])
    return points.reshape(-1, 3, 3), colors.reshape(-1, 3, 4)


def signed_volume(triangles):
    return np.einsum("ti,ti->", triangles[:, 0], np.cross(triangles[:, 1], triangles[:, 2])) / 6.0


def test_the_piece_is_closed_and_faces_outwards(scenario, triangles):
    points, _ = triangles
    y, z = np.array(scenario.obstacles[0].points).T
    area = 0.5 * abs(np.dot(y, np.roll(z, -1)) - np.dot(z, np.roll(y, -1)))
    assert signed_volume(points) == pytest.approx(0.5 * area, rel=1e-9)


def test_a_hole_is_left_free():
    outline = ((0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (0.0, 3.0))
    hole = ((1.0, 1.0), (2.0, 1.0), (2.0, 2.0))
    (marker,) = obstacle_markers([PolygonObstacle("yard", (outline, hole))], "map").markers
    points = np.array([(p.x, p.y, p.z) for p in marker.points]).reshape(-1, 3, 3)
    assert signed_volume(points) == pytest.approx(0.5 * 11.5, rel=1e-9)


def test_what_faces_upwards_is_lit(triangles):
    points, colors = triangles
    assert (colors == colors[:, :1]).all() and (colors[..., 3] == 1.0).all()
    normals = np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0])
    upwards = normals[:, 2] > 0.9 * np.linalg.norm(normals, axis=1)
    downwards = normals[:, 2] < -0.9 * np.linalg.norm(normals, axis=1)
    assert upwards.sum() > 50 and downwards.any()
    assert colors[upwards, 0, :3].min() > 0.6
    assert colors[upwards, 0, :3].min() > colors[downwards, 0, :3].max()


TURNED = (0.0, 0.0, 0.6, 0.8)  # about z: cos 0.28, sin 0.96
CUBE = MeshObstacle(
    "cube",
    str(package_share_directory() / "config" / "obstacles" / "cube.obj"),
    translation=(1.0, 2.0, 3.0),
    rotation=TURNED,
    scale=(1.0, 2.0, 3.0),
)


def test_a_small_mesh_is_drawn_where_it_is():
    (marker,) = obstacle_markers([CUBE], "map").markers
    assert (marker.type, marker.header.frame_id) == (Marker.TRIANGLE_LIST, "map")
    corners = np.array([(p.x, p.y, p.z) for p in marker.points]).reshape(-1, 3, 3)
    assert len(corners) == 12 and len(marker.colors) == 36
    assert signed_volume(corners - CUBE.translation) == pytest.approx(6.0)
    # The corner (0.5, 1, 3) of the scaled cube, turned and moved.
    expected = np.array([0.28 * 0.5 - 0.96 * 1.0, 0.96 * 0.5 + 0.28 * 1.0, 3.0]) + CUBE.translation
    assert np.abs(corners - expected).max(axis=2).min() < 1e-12


def test_a_large_mesh_is_left_to_rviz(monkeypatch):
    monkeypatch.setattr("deformable_manipulation.ros.obstacle_markers._MOST_TRIANGLES", 11)
    (marker,) = obstacle_markers([CUBE], "map").markers
    assert marker.type == Marker.MESH_RESOURCE and not marker.points
    assert marker.mesh_resource == "file://" + CUBE.mesh
    assert (marker.scale.x, marker.scale.y, marker.scale.z) == CUBE.scale
    assert (marker.pose.position.x, marker.pose.orientation.z) == (1.0, 0.6)
    assert marker.color.a == 1.0


def test_what_rviz_draws_itself_has_its_origin_taken_off(monkeypatch):
    moved = dataclasses.replace(CUBE, origin=(0.5, 0.0, 1.0))
    (drawn,) = obstacle_markers([moved], "map").markers
    monkeypatch.setattr("deformable_manipulation.ros.obstacle_markers._MOST_TRIANGLES", 11)
    (left,) = obstacle_markers([moved], "map").markers
    place = np.array([left.pose.position.x, left.pose.position.y, left.pose.position.z])
    corners = np.array([(p.x, p.y, p.z) for p in drawn.points])
    np.testing.assert_allclose(corners[:, 2].min(), place[2])
    np.testing.assert_allclose(0.5 * (corners.min(axis=0) + corners.max(axis=0))[:2], place[:2])


def test_a_large_mesh_of_a_format_that_rviz_does_not_read(monkeypatch, tmp_path):
    packed = tmp_path / "cube.obj.gz"
    with open(CUBE.mesh, "rb") as file:
        packed.write_bytes(gzip.compress(file.read()))
    monkeypatch.setattr("deformable_manipulation.ros.obstacle_markers._MOST_TRIANGLES", 11)
    (marker,) = obstacle_markers([dataclasses.replace(CUBE, mesh=str(packed))], "map").markers
    assert marker.type == Marker.TRIANGLE_LIST and len(marker.points) == 36


def test_a_moving_obstacle_is_drawn_in_a_frame_of_its_own():
    moving = dataclasses.replace(CUBE, motion=TopicMotion("pose"))
    (marker,) = obstacle_markers([moving], "map", tf_prefix="one/").markers
    assert marker.header.frame_id == "one/obstacle_cube" and marker.frame_locked
    corners = np.array([(p.x, p.y, p.z) for p in marker.points])
    np.testing.assert_allclose(corners.min(axis=0), [-0.5, -1.0, 0.0])
    np.testing.assert_allclose(corners.max(axis=0), [0.5, 1.0, 3.0])
    (standing,) = obstacle_markers([CUBE], "map", tf_prefix="one/").markers
    assert standing.header.frame_id == "map" and not standing.frame_locked


def straight_ropes(heights):
    y = np.linspace(0.0, 1.0, 11)
    return np.stack([np.stack((0 * y, y, 0 * y + height), axis=1) for height in heights])


def test_the_minimum_distances_are_drawn(scenario):
    distances = make_minimum_distance(scenario).compute(straight_ropes([0.6, 0.7, 0.8]))
    header = Header(frame_id="map", seq=3)
    line, text, copies = distance_markers(distances, header, scenario).markers
    assert all(marker.action == Marker.ADD for marker in (line, text, copies))
    assert all(marker.header == header for marker in (line, text, copies))
    start, end = (np.array([p.x, p.y, p.z]) for p in line.points)
    radius = scenario.object.radius
    length = np.linalg.norm(end - start)
    assert length == pytest.approx(distances.minimum[0], abs=1.01 * radius)
    lowest = 1e3 * distances.minimum[0]
    assert scenario.controller.collision.offset == 0.05
    assert text.text == f"{lowest:.0f} mm (limit 50 mm)" and lowest > 100.0
    assert text.pose.position.z > start[2]
    assert len(copies.points) == 4
    assert len({(marker.ns, marker.id) for marker in (line, text, copies)}) == 3


def test_what_is_no_longer_there_is_deleted(scenario):
    distances = make_minimum_distance(scenario).compute(straight_ropes([0.6]))
    _, _, copies = distance_markers(distances, Header(), scenario).markers
    assert copies.action == Marker.DELETE


def test_primitives_are_drawn_where_they_are():
    ball = SphereObstacle("ball", Sphere(0.5), translation=(1.0, 2.0, 3.0))
    (marker,) = obstacle_markers([ball], "map").markers
    corners = np.array([(p.x, p.y, p.z) for p in marker.points])
    away = np.linalg.norm(corners - ball.translation, axis=1)
    assert marker.type == Marker.TRIANGLE_LIST and away == pytest.approx(0.5)
