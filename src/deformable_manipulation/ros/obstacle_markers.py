"""Obstacles and nearest features for RViz."""

from pathlib import Path

import numpy as np
from geometry_msgs.msg import Point, Pose, Quaternion, Vector3
from std_msgs.msg import ColorRGBA, Header
from visualization_msgs.msg import Marker, MarkerArray

from deformable_manipulation.geometry.lengths import millimetres
from deformable_manipulation.geometry.rotation import rotate
from deformable_manipulation.obstacles.drawings import Dots
from deformable_manipulation.obstacles.mesh import MeshObstacle
from deformable_manipulation.obstacles.spec import placed

# A mesh of more triangles is read from its file by RViz itself, if it knows the format: to send it
# again and again for viewers that come late would hold up the distances.
_MOST_TRIANGLES = 1000
_MOST_DOTS = 50000  # balls or cubes, for the same reason
_FORMATS_OF_RVIZ = (".stl", ".dae", ".obj", ".ply")

# Namespaces of markers.
MOVING_OBSTACLES = "moving_obstacles"
DISTANCE_LABELS = "distance_labels"

_GROUND = np.array([0.80, 0.78, 0.74])  # red, green, blue
_LINE = ColorRGBA(0.75, 0.0, 0.55, 1.0)
_COPY_LINE = ColorRGBA(0.75, 0.0, 0.55, 0.35)
_LINE_WIDTH, _COPY_LINE_WIDTH = 0.01, 0.004  # m
_TEXT_HEIGHT = 0.08  # m
# m from the object, on the side away from the obstacle; beyond the folds of a fabric
_TEXT_DISTANCE, _TEXT_DISTANCE_OF_FABRIC = 0.2, 0.6

# RViz lights from where the viewer is, which leaves what faces upwards dark. The colors have the
# light in them instead: from above, a little from the front and the side.
_TO_LIGHT = np.array([0.35, -0.25, 0.9]) / np.linalg.norm([0.35, -0.25, 0.9])
_AMBIENT = 0.6  # the share of light that comes from everywhere


def obstacle_frame(obstacle, tf_prefix=""):
    """The tf frame that a moving obstacle is drawn in."""
    return f"{tf_prefix}obstacle_{obstacle.name}"


def obstacle_markers(obstacles, frame, tf_prefix=""):
    """A marker for each obstacle but live ones, whose data are shown as they come.

    Those that move are drawn in a frame of their own (:func:`obstacle_frame`), which RViz follows
    without another marker.

    Raises:
        ValueError: an obstacle's file cannot be read.
    """
    markers = []
    for index, obstacle in enumerate(obstacles):
        if obstacle.is_live:
            continue
        marker = _marker(Header(frame_id=frame), "obstacles", index, Marker.TRIANGLE_LIST)
        if obstacle.motion is not None:
            marker.ns = MOVING_OBSTACLES
            marker.header.frame_id = obstacle_frame(obstacle, tf_prefix)
            marker.frame_locked = True
            obstacle = obstacle.at((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))
        _draw(marker, obstacle)
        markers.append(marker)
    return MarkerArray(markers)


def _draw(marker, obstacle):
    drawing = obstacle.drawing()
    if isinstance(drawing, Dots):
        _draw_dots(marker, placed(obstacle, drawing.places), drawing)
    elif len(drawing.triangles) > _MOST_TRIANGLES and _is_read_by_rviz(obstacle):
        _name_file(marker, obstacle)
    else:
        _draw_surface(marker, placed(obstacle, drawing.triangles).reshape(-1, 3))


def _draw_dots(marker, places, dots):
    """Balls or cubes; of very many, some."""
    marker.type = Marker.CUBE_LIST if dots.are_cubes else Marker.SPHERE_LIST
    marker.scale.x = marker.scale.y = marker.scale.z = dots.size
    marker.color = ColorRGBA(*_GROUND, 1.0)
    marker.points = [Point(*place) for place in places[:: 1 + len(places) // _MOST_DOTS]]


def _draw_surface(marker, corners):
    """Triangles with corners (3 T, 3) [m] that face outwards."""
    marker.scale.x = marker.scale.y = marker.scale.z = 1.0
    marker.color.a = 1.0
    marker.points = [Point(*corner) for corner in corners]
    marker.colors = [ColorRGBA(*color, 1.0) for color in _lit(corners) for _ in range(3)]


def _is_read_by_rviz(obstacle):
    """Whether RViz itself can read the obstacle from its file."""
    return (
        isinstance(obstacle, MeshObstacle)
        and Path(obstacle.mesh).suffix.lower() in _FORMATS_OF_RVIZ
    )


def _name_file(marker, obstacle):
    turn = np.array([rotate(obstacle.rotation, tuple(axis)) for axis in np.eye(3)])
    origin = np.multiply(obstacle.scale, obstacle.origin) @ turn
    marker.type = Marker.MESH_RESOURCE
    marker.mesh_resource = Path(obstacle.mesh).as_uri()
    marker.color = ColorRGBA(*_GROUND, 1.0)
    marker.pose = Pose(Point(*(obstacle.translation - origin)), Quaternion(*obstacle.rotation))
    marker.scale = Vector3(*obstacle.scale)


def _lit(corners):
    """Colors (T, 3) of the triangles with corners (3 T, 3) that face outwards."""
    first, second, third = np.moveaxis(corners.reshape(-1, 3, 3), 1, 0)
    normals = np.cross(second - first, third - first)
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
    brightness = _AMBIENT + (1.0 - _AMBIENT) * np.maximum(normals @ _TO_LIGHT, 0.0)
    return brightness[:, None] * _GROUND


def distance_markers(distances, header, scenario):
    """The object's minimum distance, a line with its length, and thin lines for its copies'."""
    first = distances.offsets[:-1]
    first = first[first < distances.offsets[1:]]
    own = first[distances.offsets[0] == first]
    line = _marker(header, "distances", 0, Marker.LINE_LIST, _LINE)
    text = _marker(header, DISTANCE_LABELS, 0, Marker.TEXT_VIEW_FACING, _LINE)
    copy_lines = _marker(header, "copy_distances", 0, Marker.LINE_LIST, _COPY_LINE)
    _draw_lines(line, distances, own, _LINE_WIDTH)
    _draw_length(text, distances, own, scenario)
    _draw_lines(copy_lines, distances, first[len(own) :], _COPY_LINE_WIDTH)
    return MarkerArray([line, text, copy_lines])


def _draw_lines(marker, distances, features, width):
    """Lines between the nearest points of some features."""
    marker.scale.x = width
    for feature in features:
        marker.points.append(Point(*distances.object_point[feature]))
        marker.points.append(Point(*distances.obstacle_point[feature]))
    _delete_if_empty(marker, features)


def _draw_length(marker, distances, features, scenario):
    """The distance of a feature and its limit in words, on the object's free side."""
    marker.scale.z = _TEXT_HEIGHT
    away = _TEXT_DISTANCE_OF_FABRIC if scenario.object.is_surface else _TEXT_DISTANCE
    limit = millimetres(scenario.controller.collision.offset)
    for feature in features:
        marker.text = f"{millimetres(distances.distance[feature])} (limit {limit})"
        place = distances.object_point[feature] + away * distances.normal[feature]
        marker.pose.position = Point(*place)
    _delete_if_empty(marker, features)


def _delete_if_empty(marker, features):
    """What was drawn before must not stay."""
    if len(features) == 0:
        marker.action = Marker.DELETE


def _marker(header, namespace, number, kind, color=None):
    marker = Marker(header=header, ns=namespace, id=number, type=kind, color=color or ColorRGBA())
    marker.action = Marker.ADD
    marker.pose.orientation.w = 1.0
    return marker
