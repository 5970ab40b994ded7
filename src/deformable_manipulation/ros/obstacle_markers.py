"""Obstacles and nearest features for RViz."""

import numpy as np
import shapely
from geometry_msgs.msg import Point
from std_msgs.msg import ColorRGBA, Header
from visualization_msgs.msg import Marker, MarkerArray

from deformable_manipulation.distance.planes import PlaneFrame

_GROUND = ColorRGBA(0.62, 0.62, 0.6, 1.0)
_LINE = ColorRGBA(0.8, 0.0, 0.6, 1.0)
_LINE_WIDTH = 0.008  # m
_TEXT_HEIGHT = 0.06  # m


def obstacle_markers(obstacles, frame, half_width=0.25):
    """The piece of each planar obstacle within ``half_width`` [m] of its plane."""
    markers = []
    for index, obstacle in enumerate(obstacles):
        marker = _marker(Header(frame_id=frame), "obstacles", index, Marker.TRIANGLE_LIST, _GROUND)
        marker.scale.x = marker.scale.y = marker.scale.z = 1.0
        marker.points = [Point(*corner) for corner in _prism(obstacle, half_width)]
        markers.append(marker)
    return MarkerArray(markers)


def _prism(obstacle, half_width):
    """Corners (3 T, 3) [m] of the triangles of an obstacle's piece, facing outwards."""
    plane = PlaneFrame(obstacle.plane, obstacle.translation, obstacle.rotation, np.zeros(2))
    polygon = shapely.geometry.polygon.orient(shapely.Polygon(obstacle.points))
    ring = shapely.get_coordinates(polygon)[:-1]
    caps = _triangles(polygon)
    u, v = plane.lift(np.eye(2))
    across = half_width * np.cross(u, v)

    def lifted(corners):
        return plane.lift(corners) + np.array(obstacle.translation)

    near, far = lifted(ring) - across, lifted(ring) + across
    next_near, next_far = np.roll(near, -1, axis=0), np.roll(far, -1, axis=0)
    sides = np.stack((near, next_near, far, far, next_near, next_far), axis=1).reshape(-1, 3)
    return np.concatenate((lifted(caps[::-1]) - across, lifted(caps) + across, sides))


def _triangles(polygon):
    """Corners (3 T, 2) of triangles that make up a polygon, counterclockwise."""
    triangles = shapely.get_parts(shapely.constrained_delaunay_triangles(polygon))
    counterclockwise = [shapely.geometry.polygon.orient(triangle) for triangle in triangles]
    return np.concatenate([shapely.get_coordinates(each)[:3] for each in counterclockwise])


def distance_markers(distances, header):
    """A line and its length for the minimum distance of the object, lines for its copies."""
    markers = []
    lines = _marker(header, "distances", 0, Marker.LINE_LIST, _LINE)
    lines.scale.x = _LINE_WIDTH
    for copy, first in enumerate(distances.offsets[:-1]):
        if first == distances.offsets[copy + 1]:
            continue
        ends = Point(*distances.object_point[first]), Point(*distances.obstacle_point[first])
        lines.points.extend(ends)
        if copy == 0:
            text = _marker(header, "distances", 1, Marker.TEXT_VIEW_FACING, _LINE)
            text.scale.z = _TEXT_HEIGHT
            text.text = f"{distances.minimum[0]:.3f} m"
            middle = 0.5 * (distances.object_point[first] + distances.obstacle_point[first])
            text.pose.position = Point(*(middle + [0.0, 0.15, 0.0]))
            markers.append(text)
    if lines.points:
        markers.append(lines)
    return MarkerArray(markers)


X    marker.pose.orientation.w = 1.0
    return marker
